// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace semslam {

struct Circle {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double radius = 0;
};

// The circle that most of the points lie on (metres): of a cup, a can, a vase seen from above, of
// which usually only the front was seen. Nothing if they do not lie on an arc of at least 100
// degrees with a radius from 1.5 to 15 cm; a handle does not matter.
std::optional<Circle> FindRoundFootprint(std::span<const Eigen::Vector2d> points);

// The points of an upright thing and, if it is round, points on the back that nobody saw.
std::vector<Eigen::Vector3d> WithUnseenBack(std::span<const Eigen::Vector3d> points,
                                            const Eigen::Vector3d& up);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include <Eigen/Core>

#include "semslam/geometry/rigid3.h"

namespace semslam {

// The rigid motion T_a_b that minimises sum |a_i - T_a_b * b_i|^2 (Umeyama 1991, scale fixed at 1).
// Nothing for fewer than three pairs, or pairs so close to one line (or one point) that the
// rotation is not determined.
std::optional<Rigid3> AlignPoints(std::span<const Eigen::Vector3d> points_a,
                                  std::span<const Eigen::Vector3d> points_b);

}  // namespace semslam

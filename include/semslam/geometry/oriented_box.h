// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include <Eigen/Core>

#include "semslam/geometry/rigid3.h"

namespace semslam {

// A box with its own axes. A point p_world is inside if |T_world_box^-1 * p_world| <= half_size on
// every axis.
struct OrientedBox {
  Rigid3 T_world_box;                                   // Centre and axes.
  Eigen::Vector3d half_size = Eigen::Vector3d::Zero();  // Metres along the box's axes.

  bool Contains(const Eigen::Vector3d& p_world) const;
  double Volume() const { return 8.0 * half_size.prod(); }
};

// Encloses all points; axes from the principal directions, the one of most extent first. Empty
// input: an empty box.
OrientedBox FitOrientedBox(std::span<const Eigen::Vector3d> points);

// Encloses all points; its z axis is `up` (unit length), and around that the box is turned to the
// least area of its base, the longer side of the base along x. Empty input: an empty box.
OrientedBox FitUprightBox(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& up);

// Volume of the intersection over volume of the union, by cutting one box with the other's faces.
// In [0, 1].
double IntersectionOverUnion(const OrientedBox& a, const OrientedBox& b);

}  // namespace semslam

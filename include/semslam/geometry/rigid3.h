// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace semslam {

// Twist of a rigid motion: rotation vector (rad) first, translation (m) second.
using Vector6d = Eigen::Matrix<double, 6, 1>;

// A rotation followed by a translation. T_a_b takes a point from frame b to frame a:
//   p_a = T_a_b * p_b,  T_a_c = T_a_b * T_b_c.
struct Rigid3 {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // Hamilton, unit norm.
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();         // Metres.

  static Rigid3 FromMatrix(const Eigen::Matrix4d& matrix);
  Eigen::Matrix4d ToMatrix() const;
  Rigid3 Inverse() const;

  friend Eigen::Vector3d operator*(const Rigid3& T_a_b, const Eigen::Vector3d& p_b) {
    return T_a_b.rotation * p_b + T_a_b.translation;
  }
  friend Rigid3 operator*(const Rigid3& T_a_b, const Rigid3& T_b_c) {
    return {(T_a_b.rotation * T_b_c.rotation).normalized(), T_a_b * T_b_c.translation};
  }
};

// The 3x3 matrix with Skew(a) * b = a x b.
Eigen::Matrix3d Skew(const Eigen::Vector3d& a);

// Rotation vector (axis times angle) to rotation and back; the angle comes out in [0, pi].
Eigen::Quaterniond ExpSO3(const Eigen::Vector3d& rotation_vector);
Eigen::Vector3d LogSO3(const Eigen::Quaterniond& rotation);

// The pose perturbed on the right: rotation * Exp(delta_r), translation + rotation * delta_t.
// First-order equal to T * Exp(delta), with delta = (delta_r, delta_t). The one perturbation used
// everywhere in this project.
Rigid3 Retract(const Rigid3& T_a_b, const Vector6d& delta);
// The delta with Retract(from, delta) = to.
Vector6d LocalDifference(const Rigid3& from, const Rigid3& to);

// Angle of the rotation between two poses, radians in [0, pi].
double RotationAngle(const Rigid3& a, const Rigid3& b);

// Moves a fraction of the way from a (0) to b (1), rotation and translation separately.
Rigid3 Interpolate(const Rigid3& a, const Rigid3& b, double fraction);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/geometry/rigid3.h"

#include <algorithm>
#include <cmath>

namespace semslam {

Rigid3 Rigid3::FromMatrix(const Eigen::Matrix4d& matrix) {
  return {Eigen::Quaterniond(matrix.topLeftCorner<3, 3>()).normalized(),
          matrix.topRightCorner<3, 1>()};
}

Eigen::Matrix4d Rigid3::ToMatrix() const {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = rotation.toRotationMatrix();
  matrix.topRightCorner<3, 1>() = translation;
  return matrix;
}

Rigid3 Rigid3::Inverse() const {
  const Eigen::Quaterniond inverse = rotation.conjugate();
  return {inverse, -(inverse * translation)};
}

Eigen::Matrix3d Skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d matrix;
  matrix << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return matrix;
}

Eigen::Quaterniond ExpSO3(const Eigen::Vector3d& rotation_vector) {
  const double half_angle = 0.5 * rotation_vector.norm();
  // sin(x)/x by its series where the quotient would lose digits.
  const double sinc =
      half_angle < 1e-4 ? 1.0 - half_angle * half_angle / 6.0 : std::sin(half_angle) / half_angle;
  Eigen::Quaterniond q;
  q.w() = std::cos(half_angle);
  q.vec() = 0.5 * sinc * rotation_vector;
  return q.normalized();
}

Eigen::Vector3d LogSO3(const Eigen::Quaterniond& rotation) {
  const double sign = rotation.w() < 0 ? -1.0 : 1.0;  // q and -q are the same rotation.
  const Eigen::Vector3d v = sign * rotation.vec();
  const double sine = v.norm();
  if (sine < 1e-10) return 2.0 * v;
  return 2.0 * std::atan2(sine, sign * rotation.w()) / sine * v;
}

Rigid3 Retract(const Rigid3& T_a_b, const Vector6d& delta) {
  return {(T_a_b.rotation * ExpSO3(delta.head<3>())).normalized(),
          T_a_b.translation + T_a_b.rotation * delta.tail<3>()};
}

Vector6d LocalDifference(const Rigid3& from, const Rigid3& to) {
  const Eigen::Quaterniond inverse = from.rotation.conjugate();
  Vector6d delta;
  delta << LogSO3(inverse * to.rotation), inverse * (to.translation - from.translation);
  return delta;
}

double RotationAngle(const Rigid3& a, const Rigid3& b) {
  return LogSO3(a.rotation.conjugate() * b.rotation).norm();
}

Rigid3 Interpolate(const Rigid3& a, const Rigid3& b, double fraction) {
  return {a.rotation.slerp(fraction, b.rotation).normalized(),
          a.translation + fraction * (b.translation - a.translation)};
}

}  // namespace semslam

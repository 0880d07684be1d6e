// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "semslam/geometry/rigid3.h"

#include "optim/reprojection.h"

namespace semslam::internal {

// Sums A^T M A and A^T g (see reprojection.h) over the terms of one pose, in the blocks of
//   A^T M A = | -[p]x M [p]x  [p]x M |      A^T g = | g x p |
//             |     .            M   |              |  -g   |
class PoseNormalEquations {
 public:
  void Add(const ReprojectionTerm& term) {
    const double x = term.p_camera.x();
    const double y = term.p_camera.y();
    const double z = term.p_camera.z();
    // K = [p]x M, column by column: p x M_c.
    const double k00 = y * term.m02;
    const double k10 = z * term.m00 - x * term.m02;
    const double k20 = -y * term.m00;
    const double k01 = y * term.m12 - z * term.m11;
    const double k11 = -x * term.m12;
    const double k21 = x * term.m11;
    const double k02 = y * term.m22 - z * term.m12;
    const double k12 = z * term.m02 - x * term.m22;
    const double k22 = x * term.m12 - y * term.m02;
    rotation_[0] += y * k02 - z * k01;
    rotation_[1] += z * k00 - x * k02;
    rotation_[2] += x * k01 - y * k00;
    rotation_[3] += z * k10 - x * k12;
    rotation_[4] += x * k11 - y * k10;
    rotation_[5] += x * k21 - y * k20;
    mixed_[0] += k00;
    mixed_[1] += k10;
    mixed_[2] += k20;
    mixed_[3] += k01;
    mixed_[4] += k11;
    mixed_[5] += k21;
    mixed_[6] += k02;
    mixed_[7] += k12;
    mixed_[8] += k22;
    translation_[0] += term.m00;
    translation_[1] += term.m02;
    translation_[2] += term.m11;
    translation_[3] += term.m12;
    translation_[4] += term.m22;
    gradient_[0] += term.gradient.y() * z - term.gradient.z() * y;
    gradient_[1] += term.gradient.z() * x - term.gradient.x() * z;
    gradient_[2] += term.gradient.x() * y - term.gradient.y() * x;
    gradient_[3] -= term.gradient.x();
    gradient_[4] -= term.gradient.y();
    gradient_[5] -= term.gradient.z();
  }

  Matrix6d Hessian() const {
    Matrix6d h;
    h.topLeftCorner<3, 3>() << rotation_[0], rotation_[1], rotation_[2],  //
        rotation_[1], rotation_[3], rotation_[4],                         //
        rotation_[2], rotation_[4], rotation_[5];
    h.topRightCorner<3, 3>() = Eigen::Map<const Eigen::Matrix3d>(mixed_);
    h.bottomLeftCorner<3, 3>() = h.topRightCorner<3, 3>().transpose();
    h.bottomRightCorner<3, 3>() << translation_[0], 0, translation_[1],  //
        0, translation_[2], translation_[3],                             //
        translation_[1], translation_[3], translation_[4];
    return h;
  }
  Vector6d Gradient() const { return Eigen::Map<const Vector6d>(gradient_); }

 private:
  double rotation_[6] = {};     // Upper triangle, row by row.
  double mixed_[9] = {};        // Column by column.
  double translation_[5] = {};  // m00, m02, m11, m12, m22.
  double gradient_[6] = {};
};

}  // namespace semslam::internal

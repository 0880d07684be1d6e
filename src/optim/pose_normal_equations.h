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
template <typename T>
struct PoseSums {
  T rotation[6] = {};     // Upper triangle, row by row.
  T mixed[9] = {};        // Column by column.
  T translation[5] = {};  // m00, m02, m11, m12, m22.
  T gradient[6] = {};

  SEMSLAM_SIMD_INLINE void Add(const T& x, const T& y, const T& z, const TermSums<T>& term) {
    // K = [p]x M, column by column: p x M_c.
    const T k00 = y * term.m02;
    const T k10 = z * term.m00 - x * term.m02;
    const T k20 = -y * term.m00;
    const T k01 = y * term.m12 - z * term.m11;
    const T k11 = -x * term.m12;
    const T k21 = x * term.m11;
    const T k02 = y * term.m22 - z * term.m12;
    const T k12 = z * term.m02 - x * term.m22;
    const T k22 = x * term.m12 - y * term.m02;
    rotation[0] += y * k02 - z * k01;
    rotation[1] += z * k00 - x * k02;
    rotation[2] += x * k01 - y * k00;
    rotation[3] += z * k10 - x * k12;
    rotation[4] += x * k11 - y * k10;
    rotation[5] += x * k21 - y * k20;
    mixed[0] += k00;
    mixed[1] += k10;
    mixed[2] += k20;
    mixed[3] += k01;
    mixed[4] += k11;
    mixed[5] += k21;
    mixed[6] += k02;
    mixed[7] += k12;
    mixed[8] += k22;
    translation[0] += term.m00;
    translation[1] += term.m02;
    translation[2] += term.m11;
    translation[3] += term.m12;
    translation[4] += term.m22;
    gradient[0] += term.gradient_y * z - term.gradient_z * y;
    gradient[1] += term.gradient_z * x - term.gradient_x * z;
    gradient[2] += term.gradient_x * y - term.gradient_y * x;
    gradient[3] -= term.gradient_x;
    gradient[4] -= term.gradient_y;
    gradient[5] -= term.gradient_z;
  }
};

class PoseNormalEquations {
 public:
  PoseNormalEquations() = default;
  explicit PoseNormalEquations(const PoseSums<double>& sums) : sums_(sums) {}

  void Add(const ReprojectionTerm& term) {
    sums_.Add(term.p_camera.x(), term.p_camera.y(), term.p_camera.z(), term);
  }

  Matrix6d Hessian() const {
    Matrix6d h;
    h.topLeftCorner<3, 3>() << sums_.rotation[0], sums_.rotation[1], sums_.rotation[2],  //
        sums_.rotation[1], sums_.rotation[3], sums_.rotation[4],                         //
        sums_.rotation[2], sums_.rotation[4], sums_.rotation[5];
    h.topRightCorner<3, 3>() = Eigen::Map<const Eigen::Matrix3d>(sums_.mixed);
    h.bottomLeftCorner<3, 3>() = h.topRightCorner<3, 3>().transpose();
    h.bottomRightCorner<3, 3>() << sums_.translation[0], 0, sums_.translation[1],  //
        0, sums_.translation[2], sums_.translation[3],                             //
        sums_.translation[1], sums_.translation[3], sums_.translation[4];
    return h;
  }
  Vector6d Gradient() const { return Eigen::Map<const Vector6d>(sums_.gradient); }

 private:
  PoseSums<double> sums_;
};

}  // namespace semslam::internal

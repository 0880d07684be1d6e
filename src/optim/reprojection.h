// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "semslam/base/simd_clones.h"
#include "semslam/geometry/rigid3.h"
#include "semslam/optim/camera_model.h"

// The one residual of this module: predicted minus measured image coordinates of a point,
//   r = (fx x/z + cx - u,  fy y/z + cy - v,  fx x/z + cx - bf/z - right_x),
// with p_camera = (x, y, z) = R^T (p_world - t) for T_world_camera = (R, t). Without a measured
// right_x the third row of residual and Jacobian is zero, which adds nothing to any sum.
//
// Derivatives. By the point in the camera frame, with a = fx/z, b = fy/z, c = bf/z^2:
//       | a  0  -a x/z     |
//   P = | 0  b  -b y/z     |
//       | a  0  -a x/z + c |
// The pose moves as R <- R Exp(dr), t <- t + R dt (Retract), therefore
//   p_camera <- Exp(-dr) (p_camera - dt) = p_camera + [p_camera]x dr - dt + higher orders,
//   d r / d (dr, dt) = P A  with  A = ( [p_camera]x | -I ),
//   d r / d p_world  = P R^T.
// All normal equations are made of M = P^T P w and g = P^T r w (w = the weight), both in the
// camera frame: the pose gets A^T M A and A^T g, the point R M R^T and R g, and the two together
// A^T M R^T.
namespace semslam::internal {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Matrix63d = Eigen::Matrix<double, 6, 3>;
using Matrix36d = Eigen::Matrix<double, 3, 6>;

// Nearer points than this (m), or points behind the camera, have no projection worth the name.
inline constexpr double kMinDepth = 1e-3;
// The squared error that stands in for such a point, so that a step which pushes a point behind the
// camera costs more than it can gain: 1000 sigma.
inline constexpr double kBehindChi2 = 1e6;

inline bool IsInFront(const Eigen::Vector3d& p_camera) { return p_camera.z() > kMinDepth; }

inline Eigen::Vector3d ReprojectionResidual(const StereoCamera& camera,
                                            const Eigen::Vector3d& p_camera,
                                            const ImagePoint& image) {
  const double inverse_z = 1.0 / p_camera.z();
  const double u = camera.fx * p_camera.x() * inverse_z + camera.cx;
  const double v = camera.fy * p_camera.y() * inverse_z + camera.cy;
  return {u - image.pixel.x(), v - image.pixel.y(),
          image.has_right() ? u - camera.bf * inverse_z - image.right_x : 0.0};
}

// Squared error over its variance; kBehindChi2 for a point behind the camera.
inline double ReprojectionChi2(const StereoCamera& camera,
                               const Eigen::Vector3d& p_camera,
                               const ImagePoint& image) {
  if (!IsInFront(p_camera)) return kBehindChi2;
  return ReprojectionResidual(camera, p_camera, image).squaredNorm() * image.inverse_variance;
}

// P above.
inline Eigen::Matrix3d ProjectionJacobian(const StereoCamera& camera,
                                          const Eigen::Vector3d& p_camera,
                                          bool has_right) {
  const double inverse_z = 1.0 / p_camera.z();
  const double a = camera.fx * inverse_z;
  const double b = camera.fy * inverse_z;
  const double a_z = -a * p_camera.x() * inverse_z;
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
  jacobian(0, 0) = a;
  jacobian(0, 2) = a_z;
  jacobian(1, 1) = b;
  jacobian(1, 2) = -b * p_camera.y() * inverse_z;
  if (has_right) {
    jacobian(2, 0) = a;
    jacobian(2, 2) = a_z + camera.bf * inverse_z * inverse_z;
  }
  return jacobian;
}

// P A above.
inline Matrix36d PoseJacobian(const StereoCamera& camera,
                              const Eigen::Vector3d& p_camera,
                              bool has_right) {
  Matrix36d motion;
  motion << Skew(p_camera), -Eigen::Matrix3d::Identity();
  return ProjectionJacobian(camera, p_camera, has_right) * motion;
}

// M and g above, and the squared error, of a term; M(0, 1) is always 0. T is a number or several,
// worked on side by side.
template <typename T>
struct TermSums {
  T m00, m02, m11, m12, m22;
  T gradient_x, gradient_y, gradient_z;
  T chi2;

  SEMSLAM_SIMD_INLINE void Scale(const T& weight) {
    m00 *= weight;
    m02 *= weight;
    m11 *= weight;
    m12 *= weight;
    m22 *= weight;
    gradient_x *= weight;
    gradient_y *= weight;
    gradient_z *= weight;
  }
};

// What a camera saw of a point.
template <typename T>
struct Sight {
  T u, v, right_x;
  T weight;        // 1 / variance.
  T right_weight;  // The same, or 0 without a measured right_x.
};

// Of a point (x, y, z) in front of the camera.
template <typename T>
SEMSLAM_SIMD_INLINE TermSums<T> LinearizeSight(
    const StereoCamera& camera, const T& x, const T& y, const T& z, const Sight<T>& sight) {
  const T inverse_z = 1.0 / z;
  const T a = camera.fx * inverse_z;
  const T b = camera.fy * inverse_z;
  const T a_z = -a * x * inverse_z;
  const T b_z = -b * y * inverse_z;
  const T r_u = a * x + camera.cx - sight.u;
  const T r_v = b * y + camera.cy - sight.v;
  const T r_right = r_u + sight.u - camera.bf * inverse_z - sight.right_x;
  const T right_z = a_z + camera.bf * inverse_z * inverse_z;
  const T g_u = sight.weight * r_u;
  const T g_v = sight.weight * r_v;
  const T g_right = sight.right_weight * r_right;

  TermSums<T> term;
  term.m00 = a * a * (sight.weight + sight.right_weight);
  term.m02 = a * (sight.weight * a_z + sight.right_weight * right_z);
  term.m11 = b * b * sight.weight;
  term.m12 = b * b_z * sight.weight;
  term.m22 = sight.weight * (a_z * a_z + b_z * b_z) + sight.right_weight * right_z * right_z;
  term.gradient_x = a * (g_u + g_right);
  term.gradient_y = b * g_v;
  term.gradient_z = a_z * g_u + b_z * g_v + right_z * g_right;
  term.chi2 = g_u * r_u + g_v * r_v + g_right * r_right;
  return term;
}

// The same of one point, with it.
struct ReprojectionTerm : TermSums<double> {
  Eigen::Vector3d p_camera = Eigen::Vector3d::Zero();

  Eigen::Vector3d gradient() const { return {gradient_x, gradient_y, gradient_z}; }
  Eigen::Matrix3d Information() const {
    Eigen::Matrix3d m;
    m << m00, 0, m02, 0, m11, m12, m02, m12, m22;
    return m;
  }
};

// The point must be in front of the camera.
inline ReprojectionTerm LinearizeReprojection(const StereoCamera& camera,
                                              const Eigen::Vector3d& p_camera,
                                              const ImagePoint& image) {
  const double weight = image.inverse_variance;
  const Sight<double> sight{image.pixel.x(), image.pixel.y(), image.right_x, weight,
                            image.has_right() ? weight : 0.0};
  return {LinearizeSight(camera, p_camera.x(), p_camera.y(), p_camera.z(), sight), p_camera};
}

}  // namespace semslam::internal

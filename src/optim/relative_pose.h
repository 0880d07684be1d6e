// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <Eigen/Core>

#include "semslam/geometry/rigid3.h"

#include "optim/reprojection.h"

// The residual of a pose graph's edge: how far the relative pose T = T_world_i^-1 T_world_j = (R,
// t) is from the measured M = (R_m, t_m), as a twist in the measured frame of j,
//   r = LocalDifference(M, T) = (Log(R_m^T R),  R_m^T (t - t_m)).
//
// Derivatives. Poses move as R_i <- R_i Exp(dr_i), t_i <- t_i + R_i dt_i (Retract), therefore
//   R <- Exp(-dr_i) R Exp(dr_j) = R Exp(dr_j - R^T dr_i),
//   t <- t + [t]x dr_i - dt_i + R dt_j                    (to first order),
// and with J = the inverse of the right Jacobian of SO(3) at the rotation part of r
// (Log(Exp(a) Exp(b)) = a + J(a) b):
//   d r / d (dr_i, dt_i) = | -J R^T          0      |      d r / d (dr_j, dt_j) = | J   0       |
//                          |  R_m^T [t]x    -R_m^T  |                             | 0   R_m^T R |
namespace semslam::internal {

// J above: I + [a]x / 2 + (1 / |a|^2 - (1 + cos |a|) / (2 |a| sin |a|)) [a]x^2.
inline Eigen::Matrix3d InverseRightJacobian(const Eigen::Vector3d& a) {
  const double angle2 = a.squaredNorm();
  constexpr double kSmall2 = 1e-6;
  double factor = 1.0 / 12.0;  // The limit; the next term is angle^2 / 720.
  if (angle2 > kSmall2) {
    const double angle = std::sqrt(angle2);
    // (1 + cos) / sin = cot(angle / 2), which stays sound at half a turn.
    factor = 1.0 / angle2 - 0.5 / (angle * std::tan(0.5 * angle));
  }
  const Eigen::Matrix3d skew = Skew(a);
  return Eigen::Matrix3d::Identity() + 0.5 * skew + factor * skew * skew;
}

inline Vector6d RelativePoseResidual(const Rigid3& T_world_i,
                                     const Rigid3& T_world_j,
                                     const Rigid3& T_i_j_measured) {
  return LocalDifference(T_i_j_measured, T_world_i.Inverse() * T_world_j);
}

struct RelativePoseTerm {
  Vector6d residual;
  Matrix6d jacobian_i;
  Matrix6d jacobian_j;
};

inline RelativePoseTerm LinearizeRelativePose(const Rigid3& T_world_i,
                                              const Rigid3& T_world_j,
                                              const Rigid3& T_i_j_measured) {
  const Rigid3 T_i_j = T_world_i.Inverse() * T_world_j;
  RelativePoseTerm term;
  term.residual = LocalDifference(T_i_j_measured, T_i_j);
  const Eigen::Matrix3d R_i_j = T_i_j.rotation.toRotationMatrix();
  const Eigen::Matrix3d R_m_inverse = T_i_j_measured.rotation.toRotationMatrix().transpose();
  const Eigen::Matrix3d J_r = InverseRightJacobian(term.residual.head<3>());
  term.jacobian_i << -J_r * R_i_j.transpose(), Eigen::Matrix3d::Zero(),
      R_m_inverse * Skew(T_i_j.translation), -R_m_inverse;
  term.jacobian_j << J_r, Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero(), R_m_inverse * R_i_j;
  return term;
}

}  // namespace semslam::internal

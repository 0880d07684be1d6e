// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/geometry/plane.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace semslam {

void PointMoments::Add(const Eigen::Vector3d& point, double point_weight) {
  weight += point_weight;
  sum += point_weight * point;
  outer += point_weight * point * point.transpose();
}

PointMoments& PointMoments::operator+=(const PointMoments& other) {
  weight += other.weight;
  sum += other.sum;
  outer += other.outer;
  return *this;
}

Eigen::Vector3d PointMoments::Mean() const {
  return weight > 0 ? Eigen::Vector3d(sum / weight) : Eigen::Vector3d::Zero();
}

Eigen::Matrix3d PointMoments::Covariance() const {
  if (weight <= 0) return Eigen::Matrix3d::Zero();
  const Eigen::Vector3d mean = Mean();
  return outer / weight - mean * mean.transpose();
}

std::optional<PlaneFit> FitPlane(const PointMoments& moments) {
  if (moments.weight <= 0) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments.Covariance());
  const Eigen::Vector3d variances = solver.eigenvalues().cwiseMax(0.0);
  // Relative to the largest spread, and to what cancellation leaves of large coordinates.
  constexpr double kMinSpread = 1e-9;
  constexpr double kRounding = 1e-14;
  const Eigen::Vector3d mean = moments.Mean();
  const double floor = std::max(kMinSpread * variances[2], kRounding * mean.squaredNorm());
  if (!(variances[1] > floor)) return std::nullopt;

  PlaneFit fit;
  fit.plane.normal = solver.eigenvectors().col(0);
  fit.plane.offset = -fit.plane.normal.dot(mean);
  fit.rms = std::sqrt(variances[0]);
  fit.variation = variances[0] / variances.sum();
  fit.width = std::sqrt(variances[1]);
  return fit;
}

}  // namespace semslam

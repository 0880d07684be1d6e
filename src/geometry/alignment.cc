// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/geometry/alignment.h"

#include <Eigen/SVD>

#include "semslam/base/check.h"

namespace semslam {
namespace {

Eigen::Vector3d Mean(std::span<const Eigen::Vector3d> points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

}  // namespace

std::optional<Rigid3> AlignPoints(std::span<const Eigen::Vector3d> points_a,
                                  std::span<const Eigen::Vector3d> points_b) {
  SEMSLAM_CHECK(points_a.size() == points_b.size())
      << points_a.size() << " and " << points_b.size() << " points";
  if (points_a.size() < 3) return std::nullopt;

  const Eigen::Vector3d mean_a = Mean(points_a);
  const Eigen::Vector3d mean_b = Mean(points_b);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < points_a.size(); ++i) {
    covariance += (points_a[i] - mean_a) * (points_b[i] - mean_b).transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  // The rotation is determined only if the points span a plane at least.
  constexpr double kMinSpread = 1e-9;
  const Eigen::Vector3d& spread = svd.singularValues();
  if (spread[1] <= kMinSpread * spread[0] || spread[0] == 0.0) return std::nullopt;

  // No reflection: the sign of the least determined axis follows from the other two.
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) signs.z() = -1.0;
  const Eigen::Matrix3d rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  return Rigid3{Eigen::Quaterniond(rotation).normalized(), mean_a - rotation * mean_b};
}

}  // namespace semslam

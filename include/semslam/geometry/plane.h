// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <Eigen/Core>

namespace semslam {

// The points x with normal . x + offset = 0.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // Unit length.
  double offset = 0;                                  // Metres.

  // Metres, positive on the side the normal points to.
  double SignedDistance(const Eigen::Vector3d& point) const { return normal.dot(point) + offset; }
  Plane Flipped() const { return {-normal, -offset}; }
};

// Weight, sum and sum of outer products of weighted points. Moments of two sets add, so that planes
// are fitted to unions of sets without visiting the points again. Keep the coordinates small (up to
// kilometres) or the covariance loses its digits.
struct PointMoments {
  double weight = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d outer = Eigen::Matrix3d::Zero();

  void Add(const Eigen::Vector3d& point, double point_weight = 1.0);
  PointMoments& operator+=(const PointMoments& other);
  // Zero if nothing was added.
  Eigen::Vector3d Mean() const;
  Eigen::Matrix3d Covariance() const;
};

struct PlaneFit {
  Plane plane;     // Through the mean; the sign of the normal is arbitrary.
  double rms = 0;  // Root mean square distance of the points, metres.
  double variation =
      0;             // Least eigenvalue of the covariance over the sum of all: 0 flat, 1/3 round.
  double width = 0;  // Standard deviation along the shorter direction within the plane, metres.
};

// The plane of least squared distances. Nothing for fewer than three points or points on one line
// (or in one place), which leave the plane open.
std::optional<PlaneFit> FitPlane(const PointMoments& moments);

}  // namespace semslam

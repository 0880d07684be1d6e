// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/round_footprint.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numbers>

#include <Eigen/Dense>

#include "semslam/base/random.h"

#include "semantics/evenly_chosen.h"

namespace semslam {
namespace {

constexpr double kTolerance = 0.004;  // Metres from the circle: depth noise of near things.
constexpr double kMinRadius = 0.015;
constexpr double kMaxRadius = 0.15;
constexpr double kMinShare = 0.65;  // Of the points, on the circle.
constexpr double kMinArc = 100.0;   // Degrees, counted in sectors that have points.
constexpr int kNumSectors = 36;     // Of 10 degrees.
constexpr std::size_t kMinPoints = 30;
constexpr int kNumTrials = 100;  // 65 % inliers: all three of a trial are with 27 %.

double DistanceTo(const Circle& circle, const Eigen::Vector2d& point) {
  return std::abs((point - circle.center).norm() - circle.radius);
}

// The algebraic fit: |p|^2 = 2 c p + (r^2 - |c|^2) in least squares.
std::optional<Circle> FitCircle(std::span<const Eigen::Vector2d> points) {
  if (points.size() < 3) return std::nullopt;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const Eigen::Vector2d origin = points.front();  // Near the points, for the sake of rounding.
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d p = point - origin;
    const Eigen::Vector3d row(2 * p.x(), 2 * p.y(), 1);
    normal += row * row.transpose();
    right += row * p.squaredNorm();
  }
  const Eigen::LDLT<Eigen::Matrix3d> solver(normal);
  if (solver.info() != Eigen::Success || solver.rcond() < 1e-12) return std::nullopt;
  const Eigen::Vector3d solution = solver.solve(right);
  const double squared_radius = solution.z() + solution.head<2>().squaredNorm();
  if (!(squared_radius > 0)) return std::nullopt;
  return Circle{origin + solution.head<2>(), std::sqrt(squared_radius)};
}

bool IsPlausible(const std::optional<Circle>& circle) {
  return circle && circle->radius >= kMinRadius && circle->radius <= kMaxRadius;
}

std::vector<Eigen::Vector2d> PointsOn(const Circle& circle,
                                      std::span<const Eigen::Vector2d> points) {
  std::vector<Eigen::Vector2d> on;
  std::copy_if(points.begin(), points.end(), std::back_inserter(on),
               [&](const Eigen::Vector2d& p) { return DistanceTo(circle, p) <= kTolerance; });
  return on;
}

double ArcOf(const Circle& circle, std::span<const Eigen::Vector2d> points) {
  std::vector<bool> has_points(kNumSectors, false);
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d d = point - circle.center;
    const double turn = std::atan2(d.y(), d.x()) / (2 * std::numbers::pi) + 0.5;
    has_points[std::min<std::size_t>(static_cast<std::size_t>(turn * kNumSectors),
                                     kNumSectors - 1)] = true;
  }
  return 360.0 / kNumSectors *
         static_cast<double>(std::count(has_points.begin(), has_points.end(), true));
}

// By random triples; the same for the same points.
std::optional<Circle> BestOfTrials(std::span<const Eigen::Vector2d> points) {
  Random random(1);
  std::optional<Circle> best;
  std::size_t most = 0;
  for (int trial = 0; trial < kNumTrials; ++trial) {
    std::vector<Eigen::Vector2d> triple;
    const auto size = static_cast<std::uint32_t>(points.size());
    for (int i = 0; i < 3; ++i) triple.push_back(points[random.Index(size)]);
    const std::optional<Circle> circle = FitCircle(triple);
    if (!IsPlausible(circle)) continue;
    const std::size_t num_on = PointsOn(*circle, points).size();
    if (num_on <= most) continue;
    most = num_on;
    best = circle;
  }
  return best;
}

}  // namespace

std::optional<Circle> FindRoundFootprint(std::span<const Eigen::Vector2d> points) {
  if (points.size() < kMinPoints) return std::nullopt;
  constexpr std::size_t kMaxTried = 500;
  std::optional<Circle> circle = BestOfTrials(EvenlyChosen(points, kMaxTried));
  for (int i = 0; i < 2 && circle; ++i) circle = FitCircle(PointsOn(*circle, points));
  if (!IsPlausible(circle)) return std::nullopt;
  const std::vector<Eigen::Vector2d> on = PointsOn(*circle, points);
  const bool is_round =
      static_cast<double>(on.size()) >= kMinShare * static_cast<double>(points.size()) &&
      ArcOf(*circle, on) >= kMinArc;
  return is_round ? circle : std::nullopt;
}

std::vector<Eigen::Vector3d> WithUnseenBack(std::span<const Eigen::Vector3d> points,
                                            const Eigen::Vector3d& up) {
  std::vector<Eigen::Vector3d> whole(points.begin(), points.end());
  const Eigen::Vector3d side = up.unitOrthogonal();
  const Eigen::Vector3d other = up.cross(side);
  std::vector<Eigen::Vector2d> footprint;
  footprint.reserve(points.size());
  for (const Eigen::Vector3d& p : points) footprint.emplace_back(side.dot(p), other.dot(p));
  const std::optional<Circle> circle = FindRoundFootprint(footprint);
  if (!circle) return whole;
  const Eigen::Vector3d height = up.dot(points.front()) * up;
  for (int i = 0; i < kNumSectors; ++i) {
    const double angle = 2 * std::numbers::pi * i / kNumSectors;
    const Eigen::Vector2d p =
        circle->center + circle->radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    whole.emplace_back(height + p.x() * side + p.y() * other);
  }
  return whole;
}

}  // namespace semslam

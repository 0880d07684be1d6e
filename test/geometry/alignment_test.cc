// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/geometry/alignment.h"

#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "semslam/base/random.h"

namespace semslam {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Rigid3 SomePose() { return {ExpSO3({0.4, -1.1, 2.0}), {3, -2, 0.5}}; }

Points RandomPoints(int count, std::uint64_t seed) {
  Random random(seed);
  Points points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(random.Gaussian(), random.Gaussian(), random.Gaussian());
  }
  return points;
}

Points Transform(const Rigid3& T_a_b, const Points& points_b) {
  Points points_a;
  for (const Eigen::Vector3d& p_b : points_b) points_a.push_back(T_a_b * p_b);
  return points_a;
}

double SumOfSquares(const Rigid3& T_a_b, const Points& points_a, const Points& points_b) {
  double sum = 0;
  for (std::size_t i = 0; i < points_a.size(); ++i) {
    sum += (points_a[i] - T_a_b * points_b[i]).squaredNorm();
  }
  return sum;
}

TEST(AlignPoints, FindsAnExactMotion) {
  const Points points_b = RandomPoints(20, 1);
  const auto T_a_b = AlignPoints(Transform(SomePose(), points_b), points_b);
  ASSERT_TRUE(T_a_b);
  EXPECT_LT(LocalDifference(SomePose(), *T_a_b).norm(), 1e-12);
}

TEST(AlignPoints, IsDeterminedByThreePoints) {
  const Points points_b = RandomPoints(3, 2);
  const auto T_a_b = AlignPoints(Transform(SomePose(), points_b), points_b);
  ASSERT_TRUE(T_a_b);
  EXPECT_LT(LocalDifference(SomePose(), *T_a_b).norm(), 1e-12);
}

TEST(AlignPoints, MinimisesTheSumOfSquaresUnderNoise) {
  const Points points_b = RandomPoints(50, 3);
  Points points_a = Transform(SomePose(), points_b);
  Random random(4);
  for (Eigen::Vector3d& p : points_a) {
    p += 0.05 * Eigen::Vector3d(random.Gaussian(), random.Gaussian(), random.Gaussian());
  }
  const auto T_a_b = AlignPoints(points_a, points_b);
  ASSERT_TRUE(T_a_b);
  EXPECT_LT(LocalDifference(SomePose(), *T_a_b).norm(), 0.05);
  const double best = SumOfSquares(*T_a_b, points_a, points_b);
  for (int i = 0; i < 6; ++i) {
    for (const double step : {-1e-4, 1e-4}) {
      const Rigid3 moved = Retract(*T_a_b, step * Vector6d::Unit(i));
      EXPECT_GT(SumOfSquares(moved, points_a, points_b), best);
    }
  }
}

TEST(AlignPoints, FindsTheMotionOfPointsInAPlane) {
  Points points_b = RandomPoints(20, 5);
  for (Eigen::Vector3d& p : points_b) p.z() = 0;
  const auto T_a_b = AlignPoints(Transform(SomePose(), points_b), points_b);
  ASSERT_TRUE(T_a_b);
  EXPECT_LT(LocalDifference(SomePose(), *T_a_b).norm(), 1e-12);
}

TEST(AlignPoints, GivesARotationEvenForMirroredPoints) {
  const Points points_b = RandomPoints(20, 6);
  Points points_a = points_b;
  for (Eigen::Vector3d& p : points_a) p.x() = -p.x();
  const auto T_a_b = AlignPoints(points_a, points_b);
  ASSERT_TRUE(T_a_b);
  EXPECT_NEAR(T_a_b->rotation.toRotationMatrix().determinant(), 1.0, 1e-12);
  EXPECT_GT(SumOfSquares(*T_a_b, points_a, points_b), 0.1);
}

TEST(AlignPoints, GivesNothingForFewerThanThreePairs) {
  const Points points = RandomPoints(2, 7);
  EXPECT_FALSE(AlignPoints(points, points));
}

TEST(AlignPoints, GivesNothingForPointsOnOneLine) {
  Points points;
  for (int i = 0; i < 10; ++i) points.emplace_back(0.1 * i, 0.2 * i, -0.3 * i);
  EXPECT_FALSE(AlignPoints(Transform(SomePose(), points), points));
}

TEST(AlignPoints, GivesNothingForOnePointRepeated) {
  const Points points(10, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_FALSE(AlignPoints(Transform(SomePose(), points), points));
}

TEST(AlignPoints, RefusesListsOfDifferentLength) {
  EXPECT_THROW(AlignPoints(RandomPoints(4, 8), RandomPoints(5, 8)), std::logic_error);
}

}  // namespace
}  // namespace semslam

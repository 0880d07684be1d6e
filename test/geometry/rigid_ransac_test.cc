// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/geometry/rigid_ransac.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "semslam/base/random.h"

namespace semslam {
namespace {

// Pairs of points under one motion, a share of them wrong.
struct Pairs {
  Rigid3 T_a_b{ExpSO3({0.4, -1.1, 2.0}), {3, -2, 0.5}};
  std::vector<Eigen::Vector3d> a;
  std::vector<Eigen::Vector3d> b;
  std::vector<std::uint8_t> is_true;

  Pairs(int count, double wrong_share, double noise) {
    Random random(7);
    const auto point = [&](double size) {
      return Eigen::Vector3d(size * random.Gaussian(), size * random.Gaussian(),
                             size * random.Gaussian());
    };
    for (int i = 0; i < count; ++i) {
      b.push_back(point(1));
      is_true.push_back(random.Uniform() >= wrong_share);
      a.push_back(is_true.back() != 0 ? T_a_b * b.back() + point(noise) : point(3));
    }
  }
  auto WithinOf(double tolerance) const {
    return [this, tolerance](const Rigid3& T, std::size_t i) {
      return (a[i] - T * b[i]).norm() <= tolerance;
    };
  }
};

TEST(FindRigidConsensus, FindsTheMotionAndWhoFollowsItThoughMostPairsAreWrong) {
  const Pairs pairs(150, 0.6, 0.002);
  const auto found = FindRigidConsensus(pairs.a, pairs.b, pairs.WithinOf(0.02), {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->is_inlier, pairs.is_true);
  EXPECT_LT(LocalDifference(pairs.T_a_b, found->T_a_b).norm(), 0.002);
}

TEST(FindRigidConsensus, FindsNothingAmongPairsWithoutACommonMotion) {
  const Pairs pairs(150, 1.0, 0);
  EXPECT_FALSE(FindRigidConsensus(pairs.a, pairs.b, pairs.WithinOf(0.1), {}));
}

TEST(FindRigidConsensus, NeedsTheWantedNumberOfInliers) {
  const Pairs pairs(30, 0, 0);
  EXPECT_TRUE(FindRigidConsensus(pairs.a, pairs.b, pairs.WithinOf(0.1), {.min_inliers = 30}));
  EXPECT_FALSE(FindRigidConsensus(pairs.a, pairs.b, pairs.WithinOf(0.1), {.min_inliers = 31}));
  EXPECT_FALSE(FindRigidConsensus({}, {}, pairs.WithinOf(0.1), {}));
}

TEST(FindRigidConsensus, GivesTheSameTwice) {
  const Pairs pairs(100, 0.5, 0.01);
  const auto first = FindRigidConsensus(pairs.a, pairs.b, pairs.WithinOf(0.03), {});
  const auto second = FindRigidConsensus(pairs.a, pairs.b, pairs.WithinOf(0.03), {});
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->T_a_b.ToMatrix(), second->T_a_b.ToMatrix());
}

TEST(FindRigidConsensus, SurvivesPointsOnALine) {
  std::vector<Eigen::Vector3d> line;
  for (int i = 0; i < 40; ++i) line.emplace_back(i, 0, 0);
  EXPECT_FALSE(FindRigidConsensus(line, line, [](const Rigid3&, std::size_t) { return true; }, {}));
}

TEST(FindRigidConsensus, RefusesVectorsOfDifferentLength) {
  const Pairs pairs(30, 0, 0);
  EXPECT_THROW(FindRigidConsensus(pairs.a, {}, pairs.WithinOf(1), {}), std::logic_error);
  EXPECT_THROW(FindRigidConsensus(pairs.a, pairs.b, pairs.WithinOf(1), {.min_inliers = 2}),
               std::logic_error);
}

}  // namespace
}  // namespace semslam

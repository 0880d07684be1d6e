// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/round_footprint.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "semslam/base/random.h"
#include "semslam/geometry/oriented_box.h"

namespace semslam {
namespace {

// Points of an upright cup's outside, as far as `arc` degrees are seen, with a millimetre of noise;
// up is z.
std::vector<Eigen::Vector3d> Cup(double radius, double arc, std::size_t count) {
  Random random(7);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = random.Uniform(0, arc) * std::numbers::pi / 180.0;
    const double r = radius + random.Gaussian() * 0.001;
    points.emplace_back(1 + r * std::cos(angle), 2 + r * std::sin(angle), random.Uniform(0, 0.1));
  }
  return points;
}

std::vector<Eigen::Vector2d> FromAbove(const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector2d> footprint;
  for (const Eigen::Vector3d& p : points) footprint.emplace_back(p.head<2>());
  return footprint;
}

TEST(FindRoundFootprint, FindsACupFromItsFrontAndDespiteItsHandle) {
  std::vector<Eigen::Vector3d> points = Cup(0.042, 150, 300);
  for (int i = 0; i < 60; ++i) points.emplace_back(1.042 + 0.0005 * i, 2.0, 0.05);
  const std::optional<Circle> circle = FindRoundFootprint(FromAbove(points));
  ASSERT_TRUE(circle);
  EXPECT_NEAR(circle->radius, 0.042, 0.001);
  EXPECT_LT((circle->center - Eigen::Vector2d(1, 2)).norm(), 0.0015);
}

TEST(FindRoundFootprint, FindsNoneInWhatIsFlatOrSeenTooLittle) {
  EXPECT_FALSE(FindRoundFootprint(FromAbove(Cup(0.042, 60, 300)))) << "60 degrees";
  EXPECT_FALSE(FindRoundFootprint(FromAbove(Cup(0.3, 180, 300)))) << "a round table";
  EXPECT_FALSE(FindRoundFootprint(FromAbove(Cup(0.042, 150, 20)))) << "few points";
  std::vector<Eigen::Vector2d> board;
  Random random(1);
  for (int i = 0; i < 300; ++i)
    board.emplace_back(random.Uniform(0, 0.2), random.Gaussian() * 1e-3);
  EXPECT_FALSE(FindRoundFootprint(board));
  for (int i = 0; i < 300; ++i)
    board.emplace_back(random.Gaussian() * 1e-3, random.Uniform(0, 0.2));
  EXPECT_FALSE(FindRoundFootprint(board)) << "the corner of a crate";
  std::vector<Eigen::Vector2d> keyboard;
  for (int i = 0; i < 300; ++i) {
    keyboard.emplace_back(random.Uniform(0, 0.2), random.Uniform(0, 0.1));
  }
  EXPECT_FALSE(FindRoundFootprint(keyboard)) << "filled";
  EXPECT_FALSE(FindRoundFootprint(std::vector<Eigen::Vector2d>(100, {1, 1}))) << "one place";
}

TEST(WithUnseenBack, MakesTheBoxOfACupWhole) {
  const std::vector<Eigen::Vector3d> front = Cup(0.04, 140, 300);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  EXPECT_LT(FitUprightBox(front, up).half_size.minCoeff(), 0.03);
  const OrientedBox box = FitUprightBox(WithUnseenBack(front, up), up);
  EXPECT_NEAR(box.half_size.x(), 0.041, 0.003);
  EXPECT_NEAR(box.half_size.y(), 0.041, 0.003);
  EXPECT_NEAR(box.half_size.z(), 0.05, 0.002);
}

}  // namespace
}  // namespace semslam

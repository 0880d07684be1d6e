// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/eval/surface_match.h"

#include <gtest/gtest.h>

#include "semslam/base/random.h"

namespace semslam {
namespace {

// A square of 40 cm in the plane z = 0, samples 5 mm apart; x > 0 is instance 2, the rest 1.
struct Square {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;
  std::vector<std::uint32_t> instances;

  Square() {
    for (int i = 0; i < 80; ++i) {
      for (int j = 0; j < 80; ++j) {
        positions.emplace_back(0.005F * static_cast<float>(i) - 0.1975F,
                               0.005F * static_cast<float>(j) - 0.1975F, 0.0F);
        normals.emplace_back(0.0F, 0.0F, 1.0F);
        instances.push_back(positions.back().x() > 0 ? 2 : 1);
      }
    }
  }
  SurfaceSamples Samples() const { return {positions, normals, instances}; }
};

TEST(SurfaceMatch, MeasuresTheDistanceToTheSurfaceAndNotToItsSamples) {
  const Square square;
  Random random(1);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 1000; ++i) {
    points.emplace_back(static_cast<float>(random.Uniform(-0.19, 0.19)),
                        static_cast<float>(random.Uniform(-0.19, 0.19)), 0.003F);
  }
  const SurfaceMatch match = MatchToSurface(points, square.Samples());
  EXPECT_NEAR(match.MedianDistance(), 0.003, 1e-6);
  EXPECT_NEAR(match.Quantile(1.0), 0.003, 1e-6);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(match.instance_of_point[i], points[i].x() > 0 ? 2U : 1U) << points[i].x();
  }
}

TEST(SurfaceMatch, BeyondTheEdgeTheDistanceGrows) {
  const Square square;
  const std::vector<Eigen::Vector3f> points = {{0.1975F + 0.0275F, 0.0025F, 0}};
  const SurfaceMatch match = MatchToSurface(points, square.Samples());
  EXPECT_NEAR(match.distance_of_point[0], 0.02, 2e-4);
  EXPECT_EQ(match.instance_of_point[0], 2U);
}

TEST(SurfaceMatch, FarPointsAreOffTheSurface) {
  const Square square;
  const std::vector<Eigen::Vector3f> points = {{0, 0, 0.0495F}, {0, 0, 0.06F}, {3, 3, 3}};
  const SurfaceMatch match = MatchToSurface(points, square.Samples());
  EXPECT_EQ(match.num_off_surface, 2U);
  EXPECT_EQ(match.instance_of_point[1], SurfaceMatch::kOffSurface);
  EXPECT_FLOAT_EQ(match.distance_of_point[2], 0.05F);
}

TEST(SurfaceMatch, QuantilesAreThoseOfTheSortedDistances) {
  const Square square;
  std::vector<Eigen::Vector3f> points;
  for (int i = 20; i > 0; --i)
    points.emplace_back(0.0025F, 0.0025F, 0.001F * static_cast<float>(i));
  const SurfaceMatch match = MatchToSurface(points, square.Samples());
  EXPECT_NEAR(match.Quantile(0.95), 0.019, 1e-6);
  EXPECT_NEAR(match.MedianDistance(), 0.010, 1e-6);
  EXPECT_NEAR(match.Quantile(0.0), 0.001, 1e-6);
}

// Of 80 columns of samples the 40 of the left half have points, and 4 more are within 2 cm.
TEST(SurfaceMatch, CompletenessIsTheShareOfSamplesWithAPointNear) {
  const Square square;
  std::vector<Eigen::Vector3f> points;
  for (const Eigen::Vector3f& p : square.positions) {
    if (p.x() < 0) points.push_back(p);
  }
  EXPECT_NEAR(
      MatchToSurface(points, square.Samples(), {.completeness_distance = 0.0201}).completeness,
      44.0 / 80.0, 1e-12);
}

TEST(SurfaceMatch, NothingIsMatchedWithNothing) {
  const Square square;
  EXPECT_DOUBLE_EQ(MatchToSurface({}, square.Samples()).completeness, 0.0);
  EXPECT_DOUBLE_EQ(MatchToSurface({}, square.Samples()).MedianDistance(), 0.0);
  const std::vector<Eigen::Vector3f> points = {{0, 0, 0}};
  EXPECT_EQ(MatchToSurface(points, SurfaceSamples{}).num_off_surface, 1U);
}

TEST(SurfaceMatch, DoesNotDependOnTheNumberOfThreads) {
  const Square square;
  Random random(4);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 9000; ++i) {
    points.emplace_back(static_cast<float>(random.Uniform(-0.25, 0.25)),
                        static_cast<float>(random.Uniform(-0.25, 0.25)),
                        static_cast<float>(random.Uniform(-0.1, 0.1)));
  }
  const SurfaceMatch one = MatchToSurface(points, square.Samples(), {.num_threads = 1});
  const SurfaceMatch four = MatchToSurface(points, square.Samples(), {.num_threads = 4});
  EXPECT_EQ(one.instance_of_point, four.instance_of_point);
  EXPECT_EQ(one.distance_of_point, four.distance_of_point);
}

}  // namespace
}  // namespace semslam

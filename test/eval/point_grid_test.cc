// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/point_grid.h"

#include <limits>

#include <gtest/gtest.h>

#include "semslam/base/random.h"

namespace semslam {
namespace {

using Points = std::vector<Eigen::Vector3f>;

Points RandomPoints(int count, std::uint64_t seed) {
  Random random(seed);
  Points points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(static_cast<float>(random.Uniform(-1, 1)),
                        static_cast<float>(random.Uniform(-1, 1)),
                        static_cast<float>(random.Uniform(-0.1, 0.1)));
  }
  return points;
}

std::optional<PointGrid::Neighbour> ExhaustiveNearest(const Points& points,
                                                      const Eigen::Vector3d& p,
                                                      double max_distance) {
  std::optional<PointGrid::Neighbour> best;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double squared = (points[i].cast<double>() - p).squaredNorm();
    if (squared > max_distance * max_distance) continue;
    if (!best || squared < best->squared_distance) {
      best = PointGrid::Neighbour{static_cast<std::uint32_t>(i), squared};
    }
  }
  return best;
}

TEST(PointGrid, FindsTheNeighbourThatAnExhaustiveSearchFinds) {
  const Points points = RandomPoints(500, 1);
  const PointGrid grid(points, 0.03);
  for (const Eigen::Vector3f& query : RandomPoints(500, 2)) {
    const Eigen::Vector3d p = query.cast<double>();
    for (const double distance : {0.02, 0.1, 0.25}) {
      const auto expected = ExhaustiveNearest(points, p, distance);
      const auto found = grid.Nearest(p, distance);
      ASSERT_EQ(found.has_value(), expected.has_value());
      ASSERT_EQ(grid.Any(p, distance, [](std::uint32_t) { return true; }), expected.has_value());
      if (!expected) continue;
      ASSERT_EQ(found->index, expected->index);
      ASSERT_TRUE(grid.HasCellWithin(p, distance));
    }
  }
}

TEST(PointGrid, TellsPlacesThatAreFarFromAllPoints) {
  const PointGrid grid(Points{{0, 0, 0}}, 0.1);
  EXPECT_FALSE(grid.HasCellWithin({1, 0, 0}, 0.5));
  EXPECT_FALSE(grid.Nearest({1, 0, 0}, 0.5).has_value());
}

TEST(PointGrid, OfEquallyNearPointsTheFirstIsFound) {
  const PointGrid grid(Points{{1, 0, 0}, {-1, 0, 0}, {-1, 0, 0}}, 0.5);
  EXPECT_EQ(grid.Nearest({0, 0, 0}, 2)->index, 0U);
  EXPECT_EQ(grid.Nearest({-0.1, 0, 0}, 2)->index, 1U);
}

TEST(PointGrid, LeavesOutWhatIsNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const PointGrid grid(Points{{nan, 0, 0}, {1e30F, 0, 0}, {1, 0, 0}}, 0.5);
  EXPECT_EQ(grid.Nearest({1, 0, 0}, 0.1)->index, 2U);
  EXPECT_FALSE(grid.Nearest({nan, 0, 0}, 0.1).has_value());
  EXPECT_FALSE(PointGrid(Points{}, 0.5).Nearest({0, 0, 0}, 1).has_value());
}

}  // namespace
}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/voxel_grid.h"

#include <algorithm>
#include <limits>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "segmentation/radix_sort.h"
#include "segmentation/synthetic_scene.h"

namespace semslam {
namespace {

std::vector<Eigen::Vector3f> RandomPoints(std::size_t count, float extent, std::uint64_t seed) {
  Random random(seed);
  std::vector<Eigen::Vector3f> points;
  const auto draw = [&] { return static_cast<float>(random.Uniform(-extent, extent)); };
  for (std::size_t i = 0; i < count; ++i) points.emplace_back(draw(), draw(), draw());
  return points;
}

TEST(RadixSort, OrdersLikeAStableSort) {
  Random random(5);
  LargeVector<KeyedIndex> items;
  for (std::uint32_t i = 0; i < 5000; ++i) items.push_back({random() >> 30 & ~0xfULL, i});
  LargeVector<KeyedIndex> expected = items;
  std::stable_sort(expected.begin(), expected.end(),
                   [](const auto& a, const auto& b) { return a.key < b.key; });
  RadixSort(items, 34, 2);
  for (std::size_t i = 0; i < items.size(); ++i) {
    ASSERT_EQ(items[i].key, expected[i].key);
    ASSERT_EQ(items[i].index, expected[i].index);
  }
}

TEST(VoxelGrid, NeighboursAreThoseOfAnExhaustiveSearch) {
  const auto points = RandomPoints(3000, 0.07F, 1);
  const VoxelGrid grid = BuildVoxelGrid({points, {}}, 0.01, 2);
  for (std::size_t a = 0; a < grid.size(); ++a) {
    std::vector<std::uint32_t> expected;
    for (std::uint32_t b = 0; b < grid.size(); ++b) {
      const Eigen::Vector3i step = grid.CellOf(a) - grid.CellOf(b);
      if (a != b && step.cwiseAbs().maxCoeff() <= 1) expected.push_back(b);
    }
    const auto found = grid.NeighboursOf(a);
    ASSERT_THAT(std::vector(found.begin(), found.end()), testing::ElementsAreArray(expected));
  }
}

TEST(VoxelGrid, NeighboursAreFoundByTheStepTowardsThem) {
  const auto points = RandomPoints(3000, 0.07F, 1);
  const VoxelGrid grid = BuildVoxelGrid({points, {}}, 0.01, 2);
  std::size_t num_found = 0;
  for (std::size_t a = 0; a < grid.size(); ++a) {
    for (int bit = 0; bit < 27; ++bit) {
      const Eigen::Vector3i step(bit % 3 - 1, bit / 3 % 3 - 1, bit / 9 - 1);
      ASSERT_EQ(VoxelGrid::NeighbourBit(step.x(), step.y(), step.z()), bit);
      const std::uint32_t b = step.isZero() ? kNoVoxel : grid.NeighbourAt(a, bit);
      if (b == kNoVoxel) continue;
      ASSERT_EQ(grid.CellOf(b), grid.CellOf(a) + step);
      ++num_found;
    }
  }
  EXPECT_EQ(num_found, grid.neighbours.size());
}

TEST(VoxelGrid, EveryPointLiesInItsVoxel) {
  const auto points = RandomPoints(5000, 1.0F, 2);
  const VoxelGrid grid = BuildVoxelGrid({points, {}}, 0.05, 2);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint32_t voxel = grid.voxel_of_point[i];
    const Eigen::Vector3d cell = (points[i].cast<double>() - grid.origin) / grid.voxel_size -
                                 (grid.CellOf(voxel) - Eigen::Vector3i::Ones()).cast<double>();
    ASSERT_GE(cell.minCoeff(), -1e-9);
    ASSERT_LE(cell.maxCoeff(), 1 + 1e-9);
  }
}

TEST(VoxelGrid, CentroidIsTheMeanOfThePoints) {
  const std::vector<Eigen::Vector3f> points = {{1, 1, 1}, {1.002F, 1.004F, 1.006F}};
  const VoxelGrid grid = BuildVoxelGrid({points, {}}, 0.01, 1);
  ASSERT_EQ(grid.size(), 1U);
  const Eigen::Vector3d centroid = grid.origin + grid.centroids[0].cast<double>();
  EXPECT_NEAR((centroid - Eigen::Vector3d(1.001, 1.002, 1.003)).norm(), 0, 1e-6);
}

TEST(VoxelGrid, OrderOfThePointsHasNoEffect) {
  const test::SyntheticScene scene = test::MakeDesk();
  const auto order = test::RandomOrder(scene.points.size(), 4);
  const test::SyntheticScene shuffled = scene.Permuted(order);
  const VoxelGrid a = BuildVoxelGrid(scene.View(), 0.008, 1);
  const VoxelGrid b = BuildVoxelGrid(shuffled.View(), 0.008, 2);
  EXPECT_EQ(a.keys, b.keys);
  EXPECT_TRUE(a.centroids == b.centroids);
  EXPECT_TRUE(a.views == b.views);
  for (std::size_t voxel = 0; voxel < a.size(); ++voxel) {
    EXPECT_TRUE(std::ranges::equal(a.NeighboursOf(voxel), b.NeighboursOf(voxel)));
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    ASSERT_EQ(b.voxel_of_point[i], a.voxel_of_point[order[i]]);
  }
}

TEST(VoxelGrid, KeepsVoxelsApartOverAKilometre) {
  std::vector<Eigen::Vector3f> points;
  for (const float x : {-500.0F, 500.0F}) {
    for (const float y : {-500.0F, 500.0F}) {
      for (const float z : {-500.0F, 500.0F}) {
        points.emplace_back(x, y, z);
        points.emplace_back(x * (1 - 1e-5F), y, z);  // 5 mm inwards.
      }
    }
  }
  const VoxelGrid grid = BuildVoxelGrid({points, {}}, 0.004, 1);
  EXPECT_EQ(grid.size(), 16U);
}

TEST(VoxelGrid, PointsThatAreNotFiniteOrFarBeyondReachAreLeftOut) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const std::vector<Eigen::Vector3f> points = {
      {0, kNan, 0}, {kInfinity, 0, 0}, {0, 0, -kInfinity}, {1e30F, 0, 0}, {1, 2, 3}};
  const VoxelGrid grid = BuildVoxelGrid({points, {}}, 0.008, 1);
  EXPECT_EQ(grid.size(), 1U);
  EXPECT_THAT(grid.voxel_of_point,
              testing::ElementsAre(kNoVoxel, kNoVoxel, kNoVoxel, kNoVoxel, 0U));
}

TEST(VoxelGrid, CoarseCloudGetsVoxelsThatTouch) {
  test::SyntheticScene scene;
  scene.AddRectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, 0.0125);
  EXPECT_LT(static_cast<double>(BuildVoxelGrid(scene.View(), 0.008, 1).neighbours.size()),
            6.0 * 6400);
  const VoxelGrid grid = BuildConnectedVoxelGrid(scene.View(), 0.008, 3, 1);
  EXPECT_GE(grid.voxel_size, 0.0125);
  EXPECT_LE(grid.voxel_size, 0.024);
}

TEST(VoxelGrid, FineCloudKeepsTheVoxelSize) {
  const VoxelGrid grid = BuildConnectedVoxelGrid(test::MakeDesk().View(), 0.008, 3, 1);
  EXPECT_EQ(grid.voxel_size, 0.008);
}

}  // namespace
}  // namespace semslam

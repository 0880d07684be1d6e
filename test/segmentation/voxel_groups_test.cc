// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/voxel_groups.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semslam/base/random.h"

namespace semslam {
namespace {

TEST(VoxelGroups, HoldTheirVoxelsInOrderOnAnyNumberOfThreads) {
  constexpr std::uint32_t kNumGroups = 50;
  Random random(3);
  std::vector<std::uint32_t> group_of_voxel;
  std::vector<std::vector<std::uint32_t>> expected(kNumGroups);
  for (std::uint32_t voxel = 0; voxel < 5000; ++voxel) {
    const auto group = static_cast<std::uint32_t>(random.Index(kNumGroups + 1));
    group_of_voxel.push_back(group == kNumGroups ? kNoGroup : group);
    if (group < kNumGroups) expected[group].push_back(voxel);
  }
  for (const int num_threads : {1, 2, 5}) {
    const VoxelGroups groups = GroupVoxels(group_of_voxel, kNumGroups, num_threads);
    for (std::size_t group = 0; group < kNumGroups; ++group) {
      EXPECT_THAT(groups.Of(group), testing::ElementsAreArray(expected[group]));
    }
  }
}

TEST(VoxelGroups, MayBeEmpty) {
  const VoxelGroups groups = GroupVoxels({}, 2, 2);
  EXPECT_TRUE(groups.Of(0).empty());
  EXPECT_TRUE(groups.Of(1).empty());
}

}  // namespace
}  // namespace semslam

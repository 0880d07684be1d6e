// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/voxel_groups.h"

#include "semslam/base/parallel.h"

namespace semslam {

VoxelGroups GroupVoxels(std::span<const std::uint32_t> group_of_voxel,
                        std::size_t num_groups,
                        int num_threads) {
  constexpr std::size_t kNumChunks = 8;
  const std::size_t size = group_of_voxel.size();
  // Where the voxels of each group go, for each chunk of the voxels on its own.
  std::vector<std::vector<std::uint32_t>> places(kNumChunks);
  const auto for_chunks = [&](const auto& body) {
    ParallelFor(kNumChunks, 1, num_threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t chunk = begin; chunk < end; ++chunk) {
        places[chunk].resize(num_groups);
        for (std::size_t i = size * chunk / kNumChunks; i < size * (chunk + 1) / kNumChunks; ++i) {
          const std::uint32_t group = group_of_voxel[i];
          if (group != kNoGroup) body(static_cast<std::uint32_t>(i), places[chunk][group]);
        }
      }
    });
  };
  for_chunks([](std::uint32_t /*voxel*/, std::uint32_t& count) { ++count; });
  VoxelGroups groups;
  groups.begin.reserve(num_groups + 1);
  std::uint32_t sum = 0;
  for (std::size_t group = 0; group < num_groups; ++group) {
    groups.begin.push_back(sum);
    for (std::vector<std::uint32_t>& chunk : places) {
      const std::uint32_t count = chunk[group];
      chunk[group] = sum;
      sum += count;
    }
  }
  groups.begin.push_back(sum);
  groups.voxels.resize(sum);
  for_chunks([&](std::uint32_t voxel, std::uint32_t& place) { groups.voxels[place++] = voxel; });
  return groups;
}

}  // namespace semslam

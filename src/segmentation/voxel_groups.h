// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "semslam/base/large_vector.h"

namespace semslam {

constexpr std::uint32_t kNoGroup = std::numeric_limits<std::uint32_t>::max();

// The voxels of each group, ascending: so that groups can be summed up side by side, each in the
// order of its voxels.
struct VoxelGroups {
  LargeVector<std::uint32_t> voxels;
  std::vector<std::uint32_t> begin;  // Of each group's, and of the end.

  std::span<const std::uint32_t> Of(std::size_t group) const {
    return std::span(voxels).subspan(begin[group], begin[group + 1] - begin[group]);
  }
};

// kNoGroup: in none.
VoxelGroups GroupVoxels(std::span<const std::uint32_t> group_of_voxel,
                        std::size_t num_groups,
                        int num_threads);

}  // namespace semslam

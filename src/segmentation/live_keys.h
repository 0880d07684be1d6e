// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace semslam {

// Keys of the live segmenter's voxels and blocks: x, y, z in so many bits each, x in the high ones.
constexpr int kVoxelAxisBits = 21;

inline std::array<std::int64_t, 3> CellOf(std::uint64_t key) {
  constexpr std::uint64_t kMask = (std::uint64_t{1} << kVoxelAxisBits) - 1;
  return {static_cast<std::int64_t>(key >> (2 * kVoxelAxisBits) & kMask),
          static_cast<std::int64_t>(key >> kVoxelAxisBits & kMask),
          static_cast<std::int64_t>(key & kMask)};
}

// The entry of a key in a list that ascends by key, or where it belongs.
template <typename Voxels>
auto Place(Voxels& voxels, std::uint64_t key) {
  return std::lower_bound(voxels.begin(), voxels.end(), key,
                          [](const auto& voxel, std::uint64_t k) { return voxel.first < k; });
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "semslam/base/key_numbers.h"

namespace semslam {

// Integer coordinates of a voxel, and its 64-bit key. Keys order voxels by x, then y, then z.
struct VoxelKey {
  static constexpr std::int64_t kLimit = std::int64_t{1}
                                         << 20;  // Coordinates in [-kLimit, kLimit).

  // Nothing for points that are not finite or beyond the limit (8 km at 8 mm).
  static std::optional<Eigen::Vector3i> Coordinates(const Eigen::Vector3d& p_world,
                                                    double voxel_size);
  static std::uint64_t Pack(const Eigen::Vector3i& voxel) {
    constexpr int kBits = 21;
    const auto shifted = [](int value) { return static_cast<std::uint64_t>(value + kLimit); };
    return shifted(voxel.x()) << (2 * kBits) | shifted(voxel.y()) << kBits | shifted(voxel.z());
  }
  // Spreads neighbouring voxels over a hash table (the finaliser of SplitMix64).
  static std::uint64_t Hash(std::uint64_t key) {
    key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9ULL;
    key = (key ^ (key >> 27)) * 0x94d049bb133111ebULL;
    return key ^ (key >> 31);
  }
};

// Finds the point of a cloud (at most one a voxel) that lies at a place in the world. Immutable
// after construction; safe to share. About 20 bytes a point.
class VoxelIndex {
 public:
  VoxelIndex() = default;
  // Of several points in one voxel the first is found.
  VoxelIndex(std::span<const Eigen::Vector3f> positions, double voxel_size);

  // Index of the point in the voxel of p_world; or of the nearest one in the 26 voxels around it.
  // Nothing if all are empty.
  std::optional<std::uint32_t> Find(const Eigen::Vector3d& p_world) const;

 private:
  // 4 x 4 x 4 voxels: what is looked up one after the other lies mostly in the same few.
  struct Block {
    std::uint64_t is_occupied = 0;  // A bit a voxel.
    std::uint32_t first = 0;        // Of its points in points_, in the order of the bits.
  };
  struct Point {
    Eigen::Vector3f p_world;
    std::uint32_t index;  // In the cloud.
  };
  static std::size_t RankOf(const Block& block, int bit);  // In points_.
  const Block* FindBlock(const Eigen::Vector3i& block) const;
  const Point* FindPoint(const Block& block, int bit) const;
  std::optional<std::uint32_t> FindNear(const Eigen::Vector3d& p_world,
                                        const Eigen::Vector3i& voxel) const;

  double voxel_size_ = 1;
  KeyNumbers numbers_{0};  // Of the blocks, by the VoxelKey of their coordinates.
  std::vector<Block> blocks_;
  std::vector<Point> points_;
};

}  // namespace semslam

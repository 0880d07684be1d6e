// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
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
                                                    double voxel_size) {
    // Leaves a margin of one voxel, so that neighbours have keys too. False for NaN.
    const auto is_within = [](double value) {
      return std::abs(value) < static_cast<double>(kLimit - 2);
    };
    const Eigen::Vector3d scaled = p_world / voxel_size;
    if (!is_within(scaled.x()) || !is_within(scaled.y()) || !is_within(scaled.z())) {
      return std::nullopt;
    }
    return Eigen::Vector3i(Floor(scaled.x()), Floor(scaled.y()), Floor(scaled.z()));
  }
  // Of what an int can hold. Older processors have no instruction for it, and std::floor is a call.
  template <typename Real>
  static int Floor(Real value) {
    const int truncated = static_cast<int>(value);
    return static_cast<Real>(truncated) > value ? truncated - 1 : truncated;
  }
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
  // 4 x 4 x 4 voxels: what is looked up one after the other lies mostly in the same few.
  struct Block {
    std::uint64_t is_occupied = 0;  // A bit a voxel.
    std::uint32_t first = 0;        // Of its points, in the order of the bits.
  };
  static constexpr std::uint64_t kNoKey = std::numeric_limits<std::uint64_t>::max();

 public:
  // Looks up many places of which most lie near the one before: it remembers that one's block. Each
  // thread needs its own; the index must outlive it.
  class Finder {
   public:
    explicit Finder(const VoxelIndex& index) : index_(index) {}
    // As VoxelIndex::Find.
    std::optional<std::uint32_t> Find(const Eigen::Vector3d& p_world);

   private:
    const Block& BlockAt(const Eigen::Vector3i& block);
    std::optional<std::uint32_t> FindNear(const Eigen::Vector3d& p_world,
                                          const Eigen::Vector3i& voxel);

    const VoxelIndex& index_;
    std::uint64_t last_key_ = kNoKey;  // Of the block that was asked for last,
    Block last_;                       // and the block; an empty one if there is none.
  };

  VoxelIndex() = default;
  // Of several points in one voxel the first is found.
  VoxelIndex(std::span<const Eigen::Vector3f> positions, double voxel_size);

  // Index of the point in the voxel of p_world; or of the nearest one in the 26 voxels around it.
  // Nothing if all are empty.
  std::optional<std::uint32_t> Find(const Eigen::Vector3d& p_world) const {
    return Finder(*this).Find(p_world);
  }

 private:
  static std::size_t RankOf(const Block& block, int bit);  // Of a point among all.

  double voxel_size_ = 1;
  KeyNumbers numbers_{0};  // Of the blocks, by the VoxelKey of their coordinates.
  std::vector<Block> blocks_;
  // Of the points, in the order of the blocks and of the bits in them.
  std::vector<std::uint32_t> indices_;  // In the cloud.
  std::vector<Eigen::Vector3f> positions_;
};

}  // namespace semslam

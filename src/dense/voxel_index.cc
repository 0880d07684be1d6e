// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/dense/voxel_index.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "semslam/base/check.h"

namespace semslam {
namespace {

constexpr int kBlockBits = 2;  // Side of a block: 4 voxels.
constexpr int kBlockMask = (1 << kBlockBits) - 1;

Eigen::Vector3i BlockOf(const Eigen::Vector3i& voxel) {
  return {voxel.x() >> kBlockBits, voxel.y() >> kBlockBits, voxel.z() >> kBlockBits};
}

int BitOf(const Eigen::Vector3i& voxel) {
  return (voxel.x() & kBlockMask) << (2 * kBlockBits) | (voxel.y() & kBlockMask) << kBlockBits |
         (voxel.z() & kBlockMask);
}

// std::popcount, which is a call where processors need not have an instruction for it.
std::size_t CountBits(std::uint64_t bits) {
  bits -= bits >> 1 & 0x5555555555555555;
  bits = (bits & 0x3333333333333333) + (bits >> 2 & 0x3333333333333333);
  bits = (bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0f;
  return bits * 0x0101010101010101 >> 56;
}

// The bits of a block's voxels from one to another along an axis, both counted in the block.
std::uint64_t BitsAlongX(int first, int last) {
  return ((std::uint64_t{1} << 16 * (last - first + 1)) - 1) << 16 * first;
}
std::uint64_t BitsAlongY(int first, int last) {
  return (((std::uint64_t{1} << 4 * (last - first + 1)) - 1) << 4 * first) * 0x0001000100010001;
}
std::uint64_t BitsAlongZ(int first, int last) {
  return (((std::uint64_t{1} << (last - first + 1)) - 1) << first) * 0x1111111111111111;
}

// The part of [voxel - 1, voxel + 1] that lies in a block, along one axis, counted in the block.
struct Span {
  int first, last;
};
Span NeighboursIn(int block, int voxel) {
  const int begin = block << kBlockBits;
  return {std::max(voxel - 1, begin) - begin, std::min(voxel + 1, begin + kBlockMask) - begin};
}

// The same for all axes, as bits.
std::uint64_t NeighboursIn(const Eigen::Vector3i& block, const Eigen::Vector3i& voxel) {
  const Span x = NeighboursIn(block.x(), voxel.x());
  const Span y = NeighboursIn(block.y(), voxel.y());
  const Span z = NeighboursIn(block.z(), voxel.z());
  return BitsAlongX(x.first, x.last) & BitsAlongY(y.first, y.last) & BitsAlongZ(z.first, z.last);
}

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

}  // namespace

inline std::size_t VoxelIndex::RankOf(const Block& block, int bit) {
  return block.first + CountBits(block.is_occupied & ((std::uint64_t{1} << bit) - 1));
}

VoxelIndex::VoxelIndex(std::span<const Eigen::Vector3f> positions, double voxel_size)
    : voxel_size_(voxel_size) {
  SEMSLAM_CHECK(voxel_size > 0) << "voxel_size = " << voxel_size;
  SEMSLAM_CHECK(positions.size() < kNone);
  struct Place {
    std::uint32_t block = kNone;
    int bit = 0;
  };
  std::vector<Place> places(positions.size());
  std::uint64_t last_key = kNoKey;
  std::uint32_t last_block = kNone;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const auto voxel = VoxelKey::Coordinates(positions[i].cast<double>(), voxel_size);
    if (!voxel) continue;
    const std::uint64_t key = VoxelKey::Pack(BlockOf(*voxel));
    if (key != last_key) last_block = numbers_.Insert(key);
    last_key = key;
    places[i] = {last_block, BitOf(*voxel)};
    if (places[i].block == blocks_.size()) blocks_.emplace_back();
    blocks_[places[i].block].is_occupied |= std::uint64_t{1} << places[i].bit;
  }
  std::uint32_t num_points = 0;
  for (Block& block : blocks_) {
    block.first = num_points;
    num_points += static_cast<std::uint32_t>(CountBits(block.is_occupied));
  }
  indices_.assign(num_points, kNone);
  positions_.resize(num_points);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (places[i].block == kNone) continue;
    const std::size_t rank = RankOf(blocks_[places[i].block], places[i].bit);
    if (indices_[rank] != kNone) continue;
    indices_[rank] = static_cast<std::uint32_t>(i);
    positions_[rank] = positions[i];
  }
}

inline const VoxelIndex::Block& VoxelIndex::Finder::BlockAt(const Eigen::Vector3i& block) {
  const std::uint64_t key = VoxelKey::Pack(block);
  if (key == last_key_) return last_;
  const std::uint32_t number = index_.numbers_.Find(key);
  last_key_ = key;
  last_ = number == KeyNumbers::kNone ? Block() : index_.blocks_[number];
  return last_;
}

std::optional<std::uint32_t> VoxelIndex::Finder::Find(const Eigen::Vector3d& p_world) {
  const auto voxel = VoxelKey::Coordinates(p_world, index_.voxel_size_);
  if (!voxel) return std::nullopt;
  const int bit = BitOf(*voxel);
  const Block& block = BlockAt(BlockOf(*voxel));
  if ((block.is_occupied >> bit & 1) != 0) return index_.indices_[RankOf(block, bit)];
  return FindNear(p_world, *voxel);
}

std::optional<std::uint32_t> VoxelIndex::Finder::FindNear(const Eigen::Vector3d& p_world,
                                                          const Eigen::Vector3i& voxel) {
  std::optional<std::uint32_t> nearest;
  double nearest_distance = std::numeric_limits<double>::infinity();
  const Eigen::Vector3i low = BlockOf(voxel - Eigen::Vector3i::Ones());
  const Eigen::Vector3i high = BlockOf(voxel + Eigen::Vector3i::Ones());
  Eigen::Vector3i at;
  for (at.x() = low.x(); at.x() <= high.x(); ++at.x()) {
    for (at.y() = low.y(); at.y() <= high.y(); ++at.y()) {
      for (at.z() = low.z(); at.z() <= high.z(); ++at.z()) {
        const Block& block = BlockAt(at);
        std::uint64_t open = block.is_occupied & NeighboursIn(at, voxel);
        for (; open != 0; open &= open - 1) {
          const std::size_t rank = RankOf(block, std::countr_zero(open));
          const double distance = (index_.positions_[rank].cast<double>() - p_world).squaredNorm();
          if (distance >= nearest_distance) continue;
          nearest_distance = distance;
          nearest = index_.indices_[rank];
        }
      }
    }
  }
  return nearest;
}

}  // namespace semslam

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

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

}  // namespace

std::optional<Eigen::Vector3i> VoxelKey::Coordinates(const Eigen::Vector3d& p_world,
                                                     double voxel_size) {
  const Eigen::Vector3d scaled = p_world / voxel_size;
  // Leaves a margin of one voxel, so that neighbours have keys too. False for NaN.
  if (!(scaled.cwiseAbs().maxCoeff() < static_cast<double>(kLimit - 2))) return std::nullopt;
  return Eigen::Vector3i(scaled.array().floor().cast<int>());
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
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const auto voxel = VoxelKey::Coordinates(positions[i].cast<double>(), voxel_size);
    if (!voxel) continue;
    places[i] = {numbers_.Insert(VoxelKey::Pack(BlockOf(*voxel))), BitOf(*voxel)};
    if (places[i].block == blocks_.size()) blocks_.emplace_back();
    blocks_[places[i].block].is_occupied |= std::uint64_t{1} << places[i].bit;
  }
  std::uint32_t num_points = 0;
  for (Block& block : blocks_) {
    block.first = num_points;
    num_points += static_cast<std::uint32_t>(std::popcount(block.is_occupied));
  }
  points_.assign(num_points, {Eigen::Vector3f::Zero(), kNone});
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (places[i].block == kNone) continue;
    Point& point = points_[RankOf(blocks_[places[i].block], places[i].bit)];
    if (point.index == kNone) point = {positions[i], static_cast<std::uint32_t>(i)};
  }
}

std::optional<std::uint32_t> VoxelIndex::Find(const Eigen::Vector3d& p_world) const {
  const auto voxel = VoxelKey::Coordinates(p_world, voxel_size_);
  if (!voxel) return std::nullopt;
  if (const Block* block = FindBlock(BlockOf(*voxel))) {
    if (const Point* point = FindPoint(*block, BitOf(*voxel))) return point->index;
  }
  return FindNear(p_world, *voxel);
}

const VoxelIndex::Block* VoxelIndex::FindBlock(const Eigen::Vector3i& block) const {
  const std::uint32_t number = numbers_.Find(VoxelKey::Pack(block));
  return number == KeyNumbers::kNone ? nullptr : &blocks_[number];
}

std::size_t VoxelIndex::RankOf(const Block& block, int bit) {
  const std::uint64_t before = block.is_occupied & ((std::uint64_t{1} << bit) - 1);
  return block.first + static_cast<std::size_t>(std::popcount(before));
}

const VoxelIndex::Point* VoxelIndex::FindPoint(const Block& block, int bit) const {
  const bool is_occupied = (block.is_occupied >> bit & 1) != 0;
  return is_occupied ? &points_[RankOf(block, bit)] : nullptr;
}

std::optional<std::uint32_t> VoxelIndex::FindNear(const Eigen::Vector3d& p_world,
                                                  const Eigen::Vector3i& voxel) const {
  std::optional<std::uint32_t> nearest;
  double nearest_distance = std::numeric_limits<double>::infinity();
  const Block* block = nullptr;
  std::optional<Eigen::Vector3i> last;  // Whose block that is.
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const Eigen::Vector3i neighbour = voxel + Eigen::Vector3i(x, y, z);
        if (const Eigen::Vector3i at = BlockOf(neighbour); at != last) {
          block = FindBlock(at);
          last = at;
        }
        const Point* point = block != nullptr ? FindPoint(*block, BitOf(neighbour)) : nullptr;
        if (point == nullptr) continue;
        const double distance = (point->p_world.cast<double>() - p_world).squaredNorm();
        if (distance < nearest_distance) {
          nearest_distance = distance;
          nearest = point->index;
        }
      }
    }
  }
  return nearest;
}

}  // namespace semslam

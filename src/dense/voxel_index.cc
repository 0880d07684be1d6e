// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/dense/voxel_index.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "semslam/base/check.h"

namespace semslam {

std::optional<Eigen::Vector3i> VoxelKey::Coordinates(const Eigen::Vector3d& p_world,
                                                     double voxel_size) {
  const Eigen::Vector3d scaled = p_world / voxel_size;
  // Leaves a margin of one voxel, so that neighbours have keys too. False for NaN.
  if (!(scaled.cwiseAbs().maxCoeff() < static_cast<double>(kLimit - 2))) return std::nullopt;
  return Eigen::Vector3i(scaled.array().floor().cast<int>());
}

VoxelIndex::VoxelIndex(std::span<const Eigen::Vector3f> positions, double voxel_size)
    : voxel_size_(voxel_size), positions_(positions.begin(), positions.end()) {
  SEMSLAM_CHECK(voxel_size > 0) << "voxel_size = " << voxel_size;
  SEMSLAM_CHECK(positions.size() < std::numeric_limits<std::uint32_t>::max());
  std::size_t num_slots = 16;
  while (num_slots < positions.size() * 2) num_slots *= 2;
  slots_.assign(num_slots, 0);
  entries_.reserve(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const auto voxel = VoxelKey::Coordinates(positions[i].cast<double>(), voxel_size);
    if (!voxel) continue;
    const std::uint64_t key = VoxelKey::Pack(*voxel);
    std::size_t slot = VoxelKey::Hash(key) & (num_slots - 1);
    while (slots_[slot] != 0 && entries_[slots_[slot] - 1].key != key) {
      slot = (slot + 1) & (num_slots - 1);
    }
    if (slots_[slot] != 0) continue;
    entries_.push_back({key, static_cast<std::uint32_t>(i)});
    slots_[slot] = static_cast<std::uint32_t>(entries_.size());
  }
}

std::optional<std::uint32_t> VoxelIndex::Find(const Eigen::Vector3d& p_world) const {
  if (entries_.empty()) return std::nullopt;
  const auto voxel = VoxelKey::Coordinates(p_world, voxel_size_);
  if (!voxel) return std::nullopt;
  if (const auto index = FindKey(VoxelKey::Pack(*voxel))) return index;
  return FindNear(p_world, *voxel);
}

std::optional<std::uint32_t> VoxelIndex::FindKey(std::uint64_t key) const {
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t slot = VoxelKey::Hash(key) & mask; slots_[slot] != 0; slot = (slot + 1) & mask) {
    const Entry& entry = entries_[slots_[slot] - 1];
    if (entry.key == key) return entry.index;
  }
  return std::nullopt;
}

std::optional<std::uint32_t> VoxelIndex::FindNear(const Eigen::Vector3d& p_world,
                                                  const Eigen::Vector3i& voxel) const {
  std::optional<std::uint32_t> nearest;
  double nearest_distance = std::numeric_limits<double>::infinity();
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const auto index = FindKey(VoxelKey::Pack(voxel + Eigen::Vector3i(x, y, z)));
        if (!index) continue;
        const double distance = (positions_[*index].cast<double>() - p_world).squaredNorm();
        if (distance < nearest_distance) {
          nearest_distance = distance;
          nearest = index;
        }
      }
    }
  }
  return nearest;
}

}  // namespace semslam

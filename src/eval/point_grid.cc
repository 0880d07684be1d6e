// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/point_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "semslam/base/check.h"

namespace semslam {
PointGrid::PointGrid(std::span<const Eigen::Vector3f> points, double cell_size)
    : cell_size_(cell_size) {
  SEMSLAM_CHECK(cell_size > 0) << "cell_size = " << cell_size;
  SEMSLAM_CHECK(points.size() < std::numeric_limits<std::uint32_t>::max());
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
  keys.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto cell = VoxelKey::Coordinates(points[i].cast<double>(), cell_size);
    if (cell) keys.emplace_back(VoxelKey::Pack(*cell), static_cast<std::uint32_t>(i));
  }
  std::sort(keys.begin(), keys.end());
  entries_.reserve(keys.size());
  for (const auto& [key, index] : keys) {
    const auto position = static_cast<std::uint32_t>(entries_.size());
    if (cells_.empty() || cells_.back().key != key) cells_.push_back({key, position, position});
    entries_.push_back({points[index], index});
    ++cells_.back().end;
  }
  std::size_t num_slots = 16;
  while (num_slots < 2 * cells_.size()) num_slots *= 2;
  slots_.assign(num_slots, 0);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    std::size_t slot = VoxelKey::Hash(cells_[i].key) & (num_slots - 1);
    while (slots_[slot] != 0) slot = (slot + 1) & (num_slots - 1);
    slots_[slot] = static_cast<std::uint32_t>(i + 1);
  }
}

std::optional<PointGrid::Neighbour> PointGrid::Nearest(const Eigen::Vector3d& p,
                                                       double max_distance) const {
  const auto center = VoxelKey::Coordinates(p, cell_size_);
  if (!center) return std::nullopt;
  std::optional<Neighbour> best;
  double limit = max_distance * max_distance;
  const int reach = Reach(max_distance);
  for (int shell = 0; shell <= reach; ++shell) {
    // Every cell of the shell is at least this far away.
    const double nearest_wall = (shell - 1) * cell_size_;
    if (shell > 1 && nearest_wall * nearest_wall > limit) break;
    AnyCellOfShell(p, *center, shell, limit, [&](const Cell& cell) {
      for (std::uint32_t i = cell.begin; i < cell.end; ++i) {
        const double squared = (entries_[i].position.cast<double>() - p).squaredNorm();
        const bool is_better =
            squared < limit || (squared == limit && (!best || entries_[i].index < best->index));
        if (!is_better) continue;
        best = Neighbour{entries_[i].index, squared};
        limit = squared;
      }
      return false;
    });
  }
  return best;
}

bool PointGrid::HasCellWithin(const Eigen::Vector3d& p, double distance) const {
  const auto center = VoxelKey::Coordinates(p, cell_size_);
  if (!center) return false;
  const int reach = Reach(distance);
  const double limit = distance * distance;
  for (int shell = 0; shell <= reach; ++shell) {
    if (AnyCellOfShell(p, *center, shell, limit, [](const Cell&) { return true; })) return true;
  }
  return false;
}

int PointGrid::Reach(double distance) const {
  constexpr double kMaxReach = 1000;  // Cells; far more than anyone wants to visit.
  SEMSLAM_CHECK(distance >= 0 && distance <= kMaxReach * cell_size_) << distance;
  return static_cast<int>(std::ceil(distance / cell_size_));
}

const PointGrid::Cell* PointGrid::Find(std::uint64_t key) const {
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t slot = VoxelKey::Hash(key) & mask; slots_[slot] != 0; slot = (slot + 1) & mask) {
    const Cell& cell = cells_[slots_[slot] - 1];
    if (cell.key == key) return &cell;
  }
  return nullptr;
}

bool PointGrid::IsInRange(const Eigen::Vector3i& voxel) {
  return voxel.cwiseAbs().maxCoeff() < static_cast<int>(VoxelKey::kLimit) - 1;
}

}  // namespace semslam

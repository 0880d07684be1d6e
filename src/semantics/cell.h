// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "semslam/dense/voxel_index.h"

namespace semslam {

// A cube of space, of a grid coarser than the map's: the VoxelKey of its coordinates, so that
// ascending cells are in the order of x, y, z.
using Cell = std::uint64_t;

inline constexpr float kCellSize = 0.02F;  // Metres.

inline Cell CellOf(const Eigen::Vector3f& p) {
  return VoxelKey::Pack({VoxelKey::Floor(p.x() / kCellSize), VoxelKey::Floor(p.y() / kCellSize),
                         VoxelKey::Floor(p.z() / kCellSize)});
}

// The 26 around a cell and the cell itself, ascending.
template <typename Visit>
void ForEachNeighbour(Cell cell, const Visit& visit) {
  static const Cell origin = VoxelKey::Pack({0, 0, 0});
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) visit(cell + (VoxelKey::Pack({x, y, z}) - origin));
    }
  }
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "semslam/dense/voxel_index.h"

namespace semslam {

// Points in hashed cells, for neighbours within a few cells. Points that are not finite, or farther
// from zero than a million cells, are not found. Immutable after construction; safe to share.
class PointGrid {
 public:
  struct Neighbour {
    std::uint32_t index = 0;
    double squared_distance = 0;
  };

  PointGrid(std::span<const Eigen::Vector3f> points, double cell_size);

  // The nearest point within the distance; of equally near ones that of least index.
  std::optional<Neighbour> Nearest(const Eigen::Vector3d& p, double max_distance) const;

  // True if `is_wanted(index)` holds for a point within the distance.
  template <typename IsWanted>
  bool Any(const Eigen::Vector3d& p, double max_distance, IsWanted&& is_wanted) const {
    const auto center = VoxelKey::Coordinates(p, cell_size_);
    if (!center) return false;
    const int reach = Reach(max_distance);
    const double limit = max_distance * max_distance;
    for (int shell = 0; shell <= reach; ++shell) {
      const bool found = AnyCellOfShell(p, *center, shell, limit, [&](const Cell& cell) {
        for (std::uint32_t i = cell.begin; i < cell.end; ++i) {
          const double squared = (entries_[i].position.cast<double>() - p).squaredNorm();
          if (squared <= limit && is_wanted(entries_[i].index)) return true;
        }
        return false;
      });
      if (found) return true;
    }
    return false;
  }

  // False only if no point is within the distance. Looks at whole cells and is fast.
  bool HasCellWithin(const Eigen::Vector3d& p, double distance) const;

 private:
  struct Entry {
    Eigen::Vector3f position;
    std::uint32_t index;
  };
  struct Cell {
    std::uint64_t key = 0;
    std::uint32_t begin = 0;  // Of its entries.
    std::uint32_t end = 0;
  };

  int Reach(double distance) const;
  const Cell* Find(std::uint64_t key) const;

  // Calls visit(cell) for the cells around `p` at this Chebyshev distance that may hold something
  // within the squared distance, which visit may lower, until visit returns true.
  template <typename Visit>
  bool AnyCellOfShell(const Eigen::Vector3d& p,
                      const Eigen::Vector3i& center,
                      int shell,
                      const double& max_squared_distance,
                      Visit&& visit) const {
    for (int x = -shell; x <= shell; ++x) {
      for (int y = -shell; y <= shell; ++y) {
        const bool is_side = x == -shell || x == shell || y == -shell || y == shell;
        const int step = is_side || shell == 0 ? 1 : 2 * shell;
        for (int z = -shell; z <= shell; z += step) {
          const Eigen::Vector3i voxel = center + Eigen::Vector3i(x, y, z);
          if (SquaredDistance(p, voxel) > max_squared_distance || !IsInRange(voxel)) continue;
          const Cell* cell = Find(VoxelKey::Pack(voxel));
          if (cell != nullptr && visit(*cell)) return true;
        }
      }
    }
    return false;
  }
  // Of a point from the nearest place in a cell.
  double SquaredDistance(const Eigen::Vector3d& p, const Eigen::Vector3i& voxel) const {
    const Eigen::Vector3d low = cell_size_ * voxel.cast<double>();
    const Eigen::Vector3d nearest = p.cwiseMax(low).cwiseMin((low.array() + cell_size_).matrix());
    return (p - nearest).squaredNorm();
  }
  static bool IsInRange(const Eigen::Vector3i& voxel);

  double cell_size_;
  std::vector<Entry> entries_;  // Cell by cell.
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> slots_;  // Hash table of cell number + 1; 0: empty.
};

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "semslam/base/large_vector.h"

#include "segmentation/voxel_grid.h"

namespace semslam {

// The coarse grid over the voxels in which supervoxels are seeded, and their centres are found.
class SeedCells {
 public:
  SeedCells(const VoxelGrid& grid, double spacing, int num_threads);

  // The cells that hold voxels are numbered in the order of their first voxels.
  std::size_t num_cells() const { return cell_keys_.size(); }
  const LargeVector<std::uint32_t>& cell_of_voxel() const { return cell_of_voxel_; }

  // Calls visit for each cell, with the places (relative to the grid's origin) that lie in it or
  // the 26 around it, ascending. Cells are visited side by side.
  using Visitor = std::function<void(std::uint32_t cell, std::span<const std::uint32_t> near)>;
  void VisitNear(const std::vector<Eigen::Vector3f>& places,
                 int num_threads,
                 const Visitor& visit) const;

 private:
  std::uint64_t KeyOf(const Eigen::Vector3f& place) const;

  float cells_per_metre_;
  LargeVector<std::uint32_t> cell_of_voxel_;
  std::vector<std::uint64_t> cell_keys_;
};

}  // namespace semslam

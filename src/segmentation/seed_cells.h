// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "segmentation/voxel_grid.h"

namespace semslam {

// The coarse grid over the voxels in which supervoxels are seeded, and their centres are found.
class SeedCells {
 public:
  // For each cell a list of indices.
  struct Lists {
    std::vector<std::uint32_t> begin = {0};
    std::vector<std::uint32_t> indices;

    std::span<const std::uint32_t> Of(std::uint32_t cell) const {
      return std::span(indices).subspan(begin[cell], begin[cell + 1] - begin[cell]);
    }
  };

  SeedCells(const VoxelGrid& grid, double spacing);

  // The cells that hold voxels are numbered in the order of their first voxels.
  std::size_t num_cells() const { return cell_keys_.size(); }
  const std::vector<std::uint32_t>& cell_of_voxel() const { return cell_of_voxel_; }

  // For each cell the places (relative to the grid's origin) that lie in it or the 26 around it.
  Lists FindNear(const std::vector<Eigen::Vector3f>& places) const;

 private:
  std::uint64_t KeyOf(const Eigen::Vector3f& place) const;

  float cells_per_metre_;
  std::vector<std::uint32_t> cell_of_voxel_;
  std::vector<std::uint64_t> cell_keys_;
};

}  // namespace semslam

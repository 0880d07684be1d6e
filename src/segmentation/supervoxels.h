// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "semslam/segmentation/options.h"

#include "segmentation/voxel_grid.h"

namespace semslam {

constexpr std::uint32_t kNoPatch = std::numeric_limits<std::uint32_t>::max();

struct Supervoxels {
  std::vector<std::uint32_t> patch_of_voxel;  // kNoPatch for crumbs too small for one.
  std::uint32_t num_patches = 0;
};

// Voxel cloud connectivity segmentation: seeds on a coarse grid, from which patches grow over
// adjacent voxels, the nearest by position and normal first (each voxel is decided once, as in
// simple non-iterative clustering, Achanta and Suesstrunk, CVPR 2017). Every patch is connected, so
// that none crosses a gap.
Supervoxels GrowSupervoxels(const VoxelGrid& grid,
                            const std::vector<Eigen::Vector3f>& normals,
                            const SupervoxelOptions& options,
                            int num_threads);

}  // namespace semslam

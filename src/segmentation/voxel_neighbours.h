// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "segmentation/voxel_grid.h"

namespace semslam {

// The search looks at so many keys from any place on: where there is room for them behind the
// grid's, the keys need not move.
constexpr std::size_t kNumKeysBeyond = 3;

// Fills in the neighbours of the voxels from their keys.
void FindNeighbours(int num_threads, VoxelGrid& grid);

}  // namespace semslam

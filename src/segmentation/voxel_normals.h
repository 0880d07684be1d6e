// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "segmentation/voxel_grid.h"

namespace semslam {

// Unit normals of the voxels from the planes through the centroids within two steps of the
// neighbourhood (so never across a gap), on the side of the grid's views; zero where the
// neighbourhood leaves the plane open. Where no side is known, neighbouring normals are turned
// alike.
std::vector<Eigen::Vector3f> ComputeVoxelNormals(const VoxelGrid& grid, int num_threads);

}  // namespace semslam

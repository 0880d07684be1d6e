// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "semslam/geometry/plane.h"

#include "segmentation/supervoxels.h"
#include "segmentation/voxel_grid.h"

namespace semslam {

// A supervoxel as a piece of surface; metres, relative to the grid's origin.
struct Patch {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // Unit, towards the viewer; zero if unknown.
  double variation = 1.0 / 3.0;                      // Surface variation, see PlaneFit.
  double area = 0;                                   // Of the surface, square metres.
  std::size_t num_voxels = 0;
  PointMoments moments;  // Of the voxels' centroids.
};

struct PatchEdge {
  std::uint32_t a = 0;  // a < b.
  std::uint32_t b = 0;
  std::uint32_t num_contacts = 0;  // Pairs of adjacent voxels.
};

struct PatchGraph {
  std::vector<Patch> patches;
  std::vector<PatchEdge> edges;  // By a, then b; each pair once.
};

PatchGraph BuildPatchGraph(const VoxelGrid& grid,
                           const std::vector<Eigen::Vector3f>& normals,
                           const Supervoxels& supervoxels,
                           int num_threads);

// The same graph, from that of other supervoxels most of which have not changed: `old_number` tells
// of every patch its number in `old_graph`, where it had the same voxels; kNoPatch for the others.
// Numbers ascend as the old ones do.
PatchGraph UpdatePatchGraph(const VoxelGrid& grid,
                            const std::vector<Eigen::Vector3f>& normals,
                            const Supervoxels& supervoxels,
                            const PatchGraph& old_graph,
                            const std::vector<std::uint32_t>& old_number,
                            int num_threads);

}  // namespace semslam

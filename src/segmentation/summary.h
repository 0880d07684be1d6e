// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "semslam/segmentation/segmenter.h"

#include "segmentation/components.h"
#include "segmentation/patches.h"
#include "segmentation/supervoxels.h"
#include "segmentation/voxel_grid.h"

namespace semslam {

// The planes in the cloud's coordinates, on the side of the patches that bear their label.
std::vector<Plane> ToCloudFrame(const std::vector<Plane>& planes,
                                const PatchGraph& graph,
                                const std::vector<std::uint32_t>& plane_labels,
                                const Eigen::Vector3d& origin);

LargeVector<SegmentId> SegmentOfVoxels(const Supervoxels& supervoxels,
                                       const Components& components,
                                       int num_threads);

// `planes` as from ToCloudFrame.
std::vector<Segment> Summarise(const VoxelGrid& grid,
                               const PatchGraph& graph,
                               const Components& components,
                               const std::vector<Plane>& planes,
                               const LargeVector<SegmentId>& segment_of_voxel,
                               const std::vector<SegmentId>& segment_of_point,
                               int num_threads);

}  // namespace semslam

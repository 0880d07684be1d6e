// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "semslam/geometry/plane.h"
#include "semslam/segmentation/options.h"

#include "segmentation/patches.h"
#include "segmentation/supervoxels.h"
#include "segmentation/voxel_grid.h"

namespace semslam {

struct CutPatches {
  Supervoxels supervoxels;
  std::vector<std::uint32_t> plane_labels;
  std::vector<std::uint32_t> old_number;  // Of the patches that are as before; of others kNoPatch.
};

// A keyboard is hardly higher than the tolerance of the planes, and a patch is as large as a mouse.
// But how high a surface rises over the table around it is known much better than either: patches
// of structural planes are cut where they rise over the surface (the raised parts become patches
// without a plane, or belong to the thing they continue), next to things also where they rise less,
// and what of a thing's patches is flush with the surface goes to it. `min_structural_area`: of a
// plane, square metres.
CutPatches CutAtRelief(const VoxelGrid& grid,
                       const Supervoxels& supervoxels,
                       const PatchGraph& graph,
                       const std::vector<Plane>& planes,
                       const std::vector<std::uint32_t>& plane_labels,
                       double min_structural_area,
                       const ReliefOptions& options,
                       int num_threads);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "semslam/geometry/plane.h"
#include "semslam/segmentation/options.h"

#include "segmentation/alpha_expansion.h"
#include "segmentation/patches.h"

namespace semslam {

// The energy of giving a plane to every patch: label 0 is none and costs tau, label m > 0 is
// planes[m - 1] and costs k_im (PatchCost); different labels across an edge cost
// |n_i . n_j| tau / 2, or nothing where the normals differ much.
LabelEnergy MakeAssignmentEnergy(const PatchGraph& graph,
                                 const std::vector<Plane>& planes,
                                 const PlaneHypothesisOptions& plane_options,
                                 const PlaneAssignmentOptions& options);

// A label of low energy for every patch, as above.
std::vector<std::uint32_t> AssignPlanes(const PatchGraph& graph,
                                        const std::vector<Plane>& planes,
                                        const PlaneHypothesisOptions& plane_options,
                                        const PlaneAssignmentOptions& options);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "semslam/geometry/plane.h"
#include "semslam/segmentation/options.h"

#include "segmentation/patches.h"

namespace semslam {

// Planes that may be surfaces of the scene: one through every flat patch, and some through random
// triples of patches that a fourth confirms. Of near-duplicates the best supported stays; it is
// fitted to its support. All have the least support; the best supported comes first. Coordinates
// as the patches'.
std::vector<Plane> ProposePlanes(const std::vector<Patch>& patches,
                                 const PlaneHypothesisOptions& options,
                                 int num_threads);

// Indices of the planes that are the best supported of their cell. Cells are evenly fine over all
// directions and the same for a plane and its opposite; offsets are taken at `reference`.
std::vector<std::size_t> BestOfCells(const std::vector<Plane>& planes,
                                     const std::vector<double>& supports,
                                     const Eigen::Vector3d& reference,
                                     const PlaneHypothesisOptions& options);

}  // namespace semslam

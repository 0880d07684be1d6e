// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "semslam/segmentation/options.h"

#include "segmentation/disjoint_sets.h"
#include "segmentation/patches.h"

namespace semslam {

// Where exactly patches are: the places of their voxels, in the frame of the patches. Empty: each
// patch is taken to be at its centroid.
struct PatchPlaces {
  std::span<const Eigen::Vector3f> places;
  std::span<const std::uint32_t> patch_of_place;  // Or kNoPatch.
};

struct PartsOfScene {
  const PatchGraph& graph;
  const std::vector<std::uint32_t>& plane_labels;  // By patch; 0 for none.
  const std::vector<bool>& is_structural;          // By representative.
  const PatchPlaces& places;
};

// Nothing floats: what is seen to touch nothing belongs to something, over a gap that was not seen.
// - Fragments too small to be a thing join the thing that is nearest: the far inside of a cup,
//   beyond its rim. Pieces of floor, wall and table are not such fragments.
// - What is large enough joins the thing that stands beneath its centre of mass, if the gap is no
//   larger than the part itself: a screen and its foot.
void JoinFloatingParts(const PartsOfScene& scene,
                       const ComponentOptions& options,
                       DisjointSets& sets);

}  // namespace semslam

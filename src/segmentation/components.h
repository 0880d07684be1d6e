// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "semslam/segmentation/options.h"

#include "segmentation/floating_parts.h"
#include "segmentation/patches.h"

namespace semslam {

constexpr std::uint32_t kNoComponent = std::numeric_limits<std::uint32_t>::max();

struct Component {
  std::vector<std::uint32_t> patches;  // Ascending.
  std::uint32_t plane_label = 0;       // 0: not one plane.
  double area = 0;                     // Square metres.
  bool is_structural = false;
};

struct Components {
  std::vector<std::uint32_t> component_of_patch;  // kNoComponent for those too small.
  std::vector<Component> components;              // By their first patch.
};

// Whether the surface bends outwards from one patch to the other, or hardly at all, without a step
// (Stein et al., "Object partitioning using local convexity", CVPR 2014: convexity, smoothness and
// the sanity criterion on nearly parallel contacts).
bool IsConvex(const Patch& a, const Patch& b, const ComponentOptions& options);

// Connected components of the graph, over edges between patches of one plane and convex edges
// between patches of none. Then components that are no structural planes are joined where most of
// their common border is convex, so that the faces of a box come together, and structural planes
// where most of it is flush, so that a warped floor stays one, and also where they are large pieces
// of one plane that something hides part of. At last what is only part of a thing joins it
// (JoinThingParts, JoinFloatingParts). `plane_labels`: 0 for none.
Components FindComponents(const PatchGraph& graph,
                          const std::vector<std::uint32_t>& plane_labels,
                          const ComponentOptions& options,
                          const PatchPlaces& places = {});

}  // namespace semslam

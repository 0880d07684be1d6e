// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "semslam/segmentation/options.h"

#include "segmentation/disjoint_sets.h"
#include "segmentation/patches.h"

namespace semslam {

// By representative, square metres.
std::vector<double> AreasOf(const PatchGraph& graph, DisjointSets& sets);

// Pairs of adjacent voxels between components, given by their representatives, the lower first.
using Contacts = std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>;
Contacts ContactsBetween(const PatchGraph& graph, DisjointSets& sets);

// Joins what is one thing though concave creases part it:
// - fragments too small to be a thing with the thing they touch most;
// - what touches little but a larger rounded thing with that: things stand on flat faces, and the
//   head of a bear is the bear's.
// `is_structural`, by representative: what no thing is joined to.
void JoinThingParts(const PatchGraph& graph,
                    const std::vector<bool>& is_structural,
                    const ComponentOptions& options,
                    DisjointSets& sets);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "semslam/segmentation/options.h"

#include "segmentation/disjoint_sets.h"
#include "segmentation/patches.h"

namespace semslam {

// By representative, square metres.
std::vector<double> AreasOf(const PatchGraph& graph, DisjointSets& sets);

// Joins what is one thing though concave creases or gaps part it:
// - fragments too small to be a thing with the thing they touch most;
// - what touches little but a larger rounded thing with that: things stand on flat faces, and the
//   head of a bear is the bear's;
// - fragments that touch nothing with what is near: the far inside of a cup, beyond its rim.
// `is_structural`, by representative: what no thing is joined to.
void JoinThingParts(const PatchGraph& graph,
                    const std::vector<bool>& is_structural,
                    const ComponentOptions& options,
                    DisjointSets& sets);

}  // namespace semslam

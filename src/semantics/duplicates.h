// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "semslam/dense/map_cloud.h"
#include "semslam/semantics/semantic_map.h"

#include "semantics/segment_points.h"

namespace semslam {

// Objects of one class that are one thing seen in pieces: most of the smaller one's points are in
// the other's box, and boxes did not part them in more keyframes than held them together. Each as a
// pair of segments, one of either.
std::vector<SegmentPair> FindDuplicates(std::span<const SemanticObject> objects,
                                        const MapCloud& cloud,
                                        const SegmentPoints& segment_points,
                                        const Evidence& evidence);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "semslam/dense/map_cloud.h"
#include "semslam/semantics/evidence.h"

#include "semantics/keyframe_view.h"

namespace semslam {

// Parts segments that hold two things: those of which in a third of the keyframes that see them,
// and in at least two, two boxes claim different parts (Evidence says how often). Every point goes
// with the boxes that held it most often. Of each such segment the larger part keeps the number and
// the other gets a new one, after all others. Nothing if there is no such segment; of three things
// in one segment the first call parts one.
std::optional<Segmentation> SplitMixedSegments(const MapCloud& cloud,
                                               const Segmentation& segmentation,
                                               std::span<const SeenKeyframe> keyframes,
                                               const Evidence& evidence,
                                               const ClassTable& classes,
                                               const EvidenceOptions& options);

}  // namespace semslam

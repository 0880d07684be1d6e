// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "semslam/semantics/evidence.h"

#include "semantics/keyframe_view.h"

namespace semslam {

// What the detections of all keyframes say about the segments of the map. In every keyframe, each
// box's foreground is what is connected in depth to the middle of the box and does not belong to a
// large plane. A segment gets from a box
//   alpha(c) += p_box(c) r z e,
// r: share of its visible pixels inside the box, z: share of those that belong to the foreground,
// e: less than 1 near the box's border; of several boxes in one keyframe the best counts for each
// class. A segment that is seen well and is in no box gets evidence of being no object. Only
// visible pixels count, so occluded views say nothing. Segments larger than any instance of the
// class, and large planes, do not take the class.
Evidence CollectEvidence(std::span<const SeenKeyframe> keyframes,
                         const Segmentation& segmentation,
                         const ClassTable& classes,
                         const EvidenceOptions& options);

}  // namespace semslam

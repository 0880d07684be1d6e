// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "semslam/semantics/semantic_map.h"

#include "semantics/segment_points.h"

namespace semslam {

struct SegmentLabel {
  int class_id = kNoClass;
  double confidence = 0;        // Of the class, or of being background; 0: unknown.
  double entropy = 1;           // See Belief.
  std::uint32_t num_views = 0;  // Like the two above, of the whole object.
  SegmentId object_root = 0;    // The same for all parts of an object; itself a part of it.
};

// The class of every segment (labels[i] belongs to segment i + 1): the most probable one, if it is
// of interest, beats background and unknown, and is seen often enough. Segments of one class that
// keep being under one box and lie together become one object, and take small unlabelled pieces
// between them along.
std::vector<SegmentLabel> LabelSegments(const Evidence& evidence,
                                        const MapCloud& cloud,
                                        const Segmentation& segmentation,
                                        const SegmentPoints& segment_points,
                                        const ClassTable& classes,
                                        const FusionOptions& options);

// Makes one object of the two that each pair of segments belongs to.
void JoinObjects(std::span<const SegmentPair> pairs,
                 const Evidence& evidence,
                 const FusionOptions& options,
                 std::vector<SegmentLabel>* labels);

}  // namespace semslam

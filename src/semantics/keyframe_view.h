// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "semslam/semantics/evidence.h"

#include "semantics/box_foreground.h"

namespace semslam {

// How much of a segment one keyframe sees.
struct Visibility {
  std::uint32_t num_pixels = 0;  // Grid cells.
  double area = 0;               // Square metres of surface.
};

// The map's segments as a keyframe sees them.
struct KeyframeView {
  SegmentImage image;
  std::vector<Visibility> visibility;  // By segment id.
};

KeyframeView DrawSegments(const LabelledKeyframe& keyframe,
                          const VoxelIndex& index,
                          const Segmentation& segmentation);

// The segment that at least half of the measured cells of a box show; 0: none.
SegmentId FindFilling(const SegmentImage& image, const CellRange& box);

// Without detections that make no sense.
LabelledKeyframe Usable(const LabelledKeyframe& keyframe, const ClassTable& classes);

// By segment id: what cannot belong to a thing of the class, whatever its box holds.
std::vector<bool> FindBarriers(const Segmentation& segmentation,
                               const ClassTable& classes,
                               int class_id);

// Whether a thing of the class can be as large as the segment, and as flat.
bool CanBe(const Segment& segment, const ClassTable& classes, int class_id);

}  // namespace semslam

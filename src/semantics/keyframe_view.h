// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "semslam/semantics/evidence.h"

#include "semantics/box_foreground.h"

namespace semslam {

// A keyframe with the points of the map that it sees; the segments may still change. Of all
// keyframes of a run at once, so that it holds no more than it must.
struct SeenKeyframe {
  std::shared_ptr<const KeyframeCloud> cloud;
  std::vector<Detection> detections;  // Without those that make no sense.
  // By cell of the cloud's grid.
  std::vector<std::uint32_t> points;  // In the map's cloud; kNoPoint: none there.
  std::vector<float> areas;           // Of surface, square metres; only where there is a point.
};
inline constexpr std::uint32_t kNoPoint = 0xffffffff;

// In the order of the keyframes.
std::vector<SeenKeyframe> FindSeenPoints(std::span<const LabelledKeyframe> keyframes,
                                         const VoxelIndex& index,
                                         const ClassTable& classes);

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

KeyframeView DrawSegments(const SeenKeyframe& keyframe, const Segmentation& segmentation);

// By segment id: what cannot belong to a thing of the class, whatever its box holds.
std::vector<bool> FindBarriers(const Segmentation& segmentation,
                               const ClassTable& classes,
                               int class_id);

// Whether a thing of the class can be as large as the segment, and as flat.
bool CanBe(const Segment& segment, const ClassTable& classes, int class_id);

}  // namespace semslam

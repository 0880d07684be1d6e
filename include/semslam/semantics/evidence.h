// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "semslam/dense/keyframe_cloud.h"
#include "semslam/dense/voxel_index.h"
#include "semslam/geometry/rigid3.h"
#include "semslam/segmentation/segmenter.h"
#include "semslam/semantics/detection.h"

namespace semslam {

// A keyframe that the detector has looked at: its points, its present pose, and what was found.
struct LabelledKeyframe {
  std::shared_ptr<const KeyframeCloud> cloud;
  Rigid3 T_world_camera;
  std::vector<Detection> detections;  // Empty: looked at, nothing found.
};

struct EvidenceOptions {
  double min_inside_share = 0.6;   // Of a segment's visible pixels that must be inside the box.
  double min_filled_share = 0.1;   // Of the box's foreground that the segment must fill.
  double core_share = 0.5;         // Middle part of the box, per side, where the object surely is.
  double max_depth_step = 0.02;    // Metres between neighbouring pixels of one object, plus
  double depth_step_at_1m = 0.01;  // this times z^2 for the noise.
  int max_hole = 4;                // Grid cells without depth that do not part an object.
  double border_share = 0.08;      // Of the box's shorter side where pixels count less, down to
  double border_weight = 0.5;      // this at the border itself: boxes are not exact.
  // A segment of which this share is inside the box may be a part of the object even if
  // its depth does not join it to the foreground; weight of a box for such a part.
  double min_enclosed_share = 0.9;
  double enclosed_weight = 0.5;
  std::uint32_t min_pixels = 12;              // Grid cells; fewer tell nothing about a segment.
  double min_visible_share = 0.3;             // Of the segment's area, for evidence of a class,
  double min_visible_share_background = 0.5;  // and of there being none.
  // Of a view in which no box holds the segment, if it is as large as sure_size of the image's
  // width (side of the square of its area; COCO's "large" begins with 96 of 640 pixels); less in
  // proportion if it is smaller.
  double background_weight = 0.2;
  double sure_size = 0.15;

  void Validate() const;  // Throws InputError.
};

// Sums over keyframes for one segment, in units of kEvidenceUnit. Integers, so that the order of
// keyframes does not matter.
struct SegmentEvidence {
  std::vector<std::int64_t> alpha;       // By class.
  std::vector<std::int64_t> part_alpha;  // The same without the rule of min_filled_share: the small
                                         // pieces of an over-segmented object.
  std::vector<std::uint32_t> num_views;  // By class: keyframes whose box held the segment.
  std::int64_t background = 0;
  std::uint32_t num_seen = 0;    // Keyframes that saw enough of it to judge.
  std::uint32_t num_parted = 0;  // Keyframes in which two boxes claimed different parts of it.
};
inline constexpr double kEvidenceUnit = 1.0 / (1 << 20);

using SegmentPair = std::pair<SegmentId, SegmentId>;  // The lower id first.

// Boxes of one class.
using SegmentAndClass = std::pair<SegmentId, int>;

// A box, by the places of its keyframe and its detection among all.
struct BoxPlace {
  std::size_t keyframe = 0;
  std::size_t detection = 0;
};

struct Evidence {
  std::vector<SegmentEvidence> segments;  // segments[i] belongs to segment i + 1.
  // The boxes of a class that were filled by a segment that is too large for it.
  std::map<SegmentAndClass, std::vector<BoxPlace>> filled_boxes;
  // In how many keyframes two segments belonged to the foreground of one box.
  std::map<SegmentPair, std::uint32_t> num_shared_boxes;
  // In how many two boxes of one class held one segment each, and no box both.
  std::map<SegmentPair, std::uint32_t> num_separate_boxes;
};

}  // namespace semslam

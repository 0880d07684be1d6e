// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/keyframe_view.h"

#include <algorithm>
#include <cstddef>
#include <optional>

#include "semslam/base/check.h"
#include "semslam/base/parallel.h"

namespace semslam {
namespace {

constexpr double kMinCosine = 0.2;  // Of slanted views, when pixels are turned into areas.

// Of the surface that a grid cell of this size at 1 m shows, square metres.
float AreaOf(const KeyframePoint& point, double size_at_1m) {
  const double side = size_at_1m * point.p_camera.z();
  const double cosine = -point.n_camera.dot(point.p_camera.normalized());
  return static_cast<float>(side * side / std::max(cosine, kMinCosine));
}

SeenKeyframe FindSeenPoints(const LabelledKeyframe& keyframe,
                            const VoxelIndex& index,
                            const ClassTable& classes) {
  SEMSLAM_CHECK(keyframe.cloud != nullptr);
  const KeyframeCloud& cloud = *keyframe.cloud;
  SeenKeyframe seen;
  seen.cloud = keyframe.cloud;
  seen.detections =
      Sanitise(keyframe.detections, classes.size(), cloud.image_width(), cloud.image_height());
  seen.points.assign(cloud.num_cells(), kNoPoint);
  seen.areas.resize(cloud.num_cells());
  const double size_at_1m = static_cast<double>(cloud.pixel_angle()) * cloud.stride();
  VoxelIndex::Finder finder(index);
  cloud.ForEachCell([&](std::size_t cell, const KeyframePoint& point) {
    const auto in_map = finder.Find(keyframe.T_world_camera * point.p_camera.cast<double>());
    if (!in_map) return;
    seen.points[cell] = *in_map;
    seen.areas[cell] = AreaOf(point, size_at_1m);
  });
  return seen;
}

}  // namespace

std::vector<SeenKeyframe> FindSeenPoints(std::span<const LabelledKeyframe> keyframes,
                                         const VoxelIndex& index,
                                         const ClassTable& classes) {
  std::vector<SeenKeyframe> seen(keyframes.size());
  ParallelFor(keyframes.size(), 1, 0, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      seen[i] = FindSeenPoints(keyframes[i], index, classes);
    }
  });
  return seen;
}

KeyframeView DrawSegments(const SeenKeyframe& keyframe, const Segmentation& segmentation) {
  KeyframeView view;
  view.image.columns = keyframe.cloud->grid_columns();
  view.image.rows = keyframe.cloud->grid_rows();
  view.image.segments.assign(keyframe.points.size(), 0);
  view.visibility.resize(segmentation.segments.size() + 1);
  for (std::size_t cell = 0; cell < keyframe.points.size(); ++cell) {
    if (keyframe.points[cell] == kNoPoint) continue;
    const SegmentId segment = segmentation.segment_of_point[keyframe.points[cell]];
    if (segment == 0) continue;
    view.image.segments[cell] = segment;
    view.visibility[segment].area += static_cast<double>(keyframe.areas[cell]);
    ++view.visibility[segment].num_pixels;
  }
  return view;
}

bool CanBe(const Segment& segment, const ClassTable& classes, int class_id) {
  if (segment.is_structural && !classes.may_be_structural(class_id)) return false;
  return 2 * segment.box.half_size.maxCoeff() <= classes.max_extent(class_id);
}

std::vector<bool> FindBarriers(const Segmentation& segmentation,
                               const ClassTable& classes,
                               int class_id) {
  std::vector<bool> is_barrier(segmentation.segments.size() + 1, false);
  if (classes.may_be_structural(class_id)) return is_barrier;
  for (const Segment& segment : segmentation.segments)
    is_barrier[segment.id] = segment.is_structural;
  return is_barrier;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/keyframe_view.h"

#include <algorithm>
#include <cstddef>
#include <map>

#include "semslam/base/check.h"
#include "semslam/base/parallel.h"

namespace semslam {
namespace {

constexpr double kMinCosine = 0.2;  // Of slanted views, when pixels are turned into areas.

SeenKeyframe FindSeenPoints(const LabelledKeyframe& keyframe,
                            const VoxelIndex& index,
                            const ClassTable& classes) {
  SEMSLAM_CHECK(keyframe.cloud != nullptr);
  const KeyframeCloud& cloud = *keyframe.cloud;
  SeenKeyframe seen;
  seen.cloud = keyframe.cloud;
  seen.detections =
      Sanitise(keyframe.detections, classes.size(), cloud.image_width(), cloud.image_height());
  const auto columns = static_cast<std::size_t>(cloud.grid_columns());
  const std::size_t num_cells = columns * static_cast<std::size_t>(cloud.grid_rows());
  seen.points.assign(num_cells, kNoPoint);
  seen.depth.assign(num_cells, 0.0F);
  seen.areas.assign(num_cells, 0.0F);
  const double cell_angle = static_cast<double>(cloud.pixel_angle()) * cloud.stride();
  cloud.ForEach([&](const KeyframePoint& point) {
    const std::size_t cell = static_cast<std::size_t>(point.row / cloud.stride()) * columns +
                             static_cast<std::size_t>(point.column / cloud.stride());
    seen.depth[cell] = point.p_camera.z();
    const auto found = index.Find(keyframe.T_world_camera * point.p_camera.cast<double>());
    if (!found) return;
    const double side = cell_angle * point.p_camera.z();
    const double cosine = -point.n_camera.dot(point.p_camera.normalized());
    seen.points[cell] = *found;
    seen.areas[cell] = static_cast<float>(side * side / std::max(cosine, kMinCosine));
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
  SegmentImage& image = view.image;
  image.columns = keyframe.cloud->grid_columns();
  image.rows = keyframe.cloud->grid_rows();
  image.depth = keyframe.depth;
  image.points = keyframe.points;
  image.segments.assign(keyframe.points.size(), 0);
  view.visibility.resize(segmentation.segments.size() + 1);
  for (std::size_t cell = 0; cell < keyframe.points.size(); ++cell) {
    if (keyframe.points[cell] == kNoPoint) continue;
    const SegmentId segment = segmentation.segment_of_point[keyframe.points[cell]];
    if (segment == 0) continue;
    image.segments[cell] = segment;
    view.visibility[segment].area += static_cast<double>(keyframe.areas[cell]);
    ++view.visibility[segment].num_pixels;
  }
  return view;
}

SegmentId FindFilling(const SegmentImage& image, const CellRange& box) {
  std::map<SegmentId, std::size_t> counts;
  std::size_t num_measured = 0;
  for (int row = box.first_row; row < box.last_row; ++row) {
    for (int column = box.first_column; column < box.last_column; ++column) {
      const std::size_t cell = image.Cell(column, row);
      if (image.depth[cell] <= 0) continue;
      ++num_measured;
      ++counts[image.segments[cell]];
    }
  }
  for (const auto& [segment, count] : counts) {
    if (segment != 0 && 2 * count >= num_measured) return segment;
  }
  return 0;
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

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

// Of the surface that a grid cell shows, square metres.
float AreaOf(const KeyframePoint& point, const KeyframeCloud& cloud) {
  const double side =
      static_cast<double>(cloud.pixel_angle()) * cloud.stride() * point.p_camera.z();
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
  seen.points.reserve(cloud.num_points());
  seen.areas.reserve(cloud.num_points());
  cloud.ForEach([&](const KeyframePoint& point) {
    const auto found = index.Find(keyframe.T_world_camera * point.p_camera.cast<double>());
    seen.points.push_back(found.value_or(kNoPoint));
    seen.areas.push_back(AreaOf(point, cloud));
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
  const KeyframeCloud& cloud = *keyframe.cloud;
  KeyframeView view;
  SegmentImage& image = view.image;
  image.columns = cloud.grid_columns();
  image.rows = cloud.grid_rows();
  const auto num_cells =
      static_cast<std::size_t>(image.columns) * static_cast<std::size_t>(image.rows);
  image.depth.assign(num_cells, 0.0F);
  image.points.assign(num_cells, kNoPoint);
  image.segments.assign(num_cells, 0);
  view.visibility.resize(segmentation.segments.size() + 1);
  std::size_t point = 0;
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.columns; ++column) {
      const float depth = cloud.DepthAt(column, row);
      if (depth == 0) continue;
      const std::uint32_t in_map = keyframe.points[point];
      const float area = keyframe.areas[point++];
      const std::size_t cell = image.Cell(column, row);
      image.depth[cell] = depth;
      if (in_map == kNoPoint) continue;
      image.points[cell] = in_map;
      const SegmentId segment = segmentation.segment_of_point[in_map];
      if (segment == 0) continue;
      image.segments[cell] = segment;
      view.visibility[segment].area += static_cast<double>(area);
      ++view.visibility[segment].num_pixels;
    }
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

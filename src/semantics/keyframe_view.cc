// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/keyframe_view.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include "semslam/base/check.h"

namespace semslam {
namespace {

constexpr double kMinCosine = 0.2;  // Of slanted views, when pixels are turned into areas.

}  // namespace

KeyframeView DrawSegments(const LabelledKeyframe& keyframe,
                          const VoxelIndex& index,
                          const Segmentation& segmentation) {
  const KeyframeCloud& cloud = *keyframe.cloud;
  KeyframeView view;
  SegmentImage& image = view.image;
  image.columns = cloud.grid_columns();
  image.rows = cloud.grid_rows();
  const std::size_t num_cells =
      static_cast<std::size_t>(image.columns) * static_cast<std::size_t>(image.rows);
  image.segments.assign(num_cells, 0);
  image.depth.assign(num_cells, 0.0F);
  image.points.assign(num_cells, 0);
  view.visibility.resize(segmentation.segments.size() + 1);
  const double cell_angle = static_cast<double>(cloud.pixel_angle()) * cloud.stride();
  cloud.ForEach([&](const KeyframePoint& point) {
    const std::size_t cell = image.Cell(point.column / cloud.stride(), point.row / cloud.stride());
    image.depth[cell] = point.p_camera.z();
    const auto found = index.Find(keyframe.T_world_camera * point.p_camera.cast<double>());
    if (!found) return;
    const SegmentId segment = segmentation.segment_of_point[*found];
    if (segment == 0) return;
    image.segments[cell] = segment;
    image.points[cell] = *found;
    const double side = cell_angle * point.p_camera.z();
    const double cosine = -point.n_camera.dot(point.p_camera.normalized());
    view.visibility[segment].area += side * side / std::max(cosine, kMinCosine);
    ++view.visibility[segment].num_pixels;
  });
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

LabelledKeyframe Usable(const LabelledKeyframe& keyframe, const ClassTable& classes) {
  SEMSLAM_CHECK(keyframe.cloud != nullptr);
  LabelledKeyframe usable = keyframe;
  usable.detections = Sanitise(std::move(usable.detections), classes.size(),
                               keyframe.cloud->image_width(), keyframe.cloud->image_height());
  return usable;
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

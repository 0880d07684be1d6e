// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/segment_parts.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "semslam/base/check.h"

namespace semslam {
namespace {

// Sets what depends on the points; the area in proportion to their number.
void Measure(std::span<const std::uint32_t> points,
             const Segment& whole,
             const MapCloud& cloud,
             Segment* part) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(points.size());
  part->centroid.setZero();
  for (const std::uint32_t point : points) {
    positions.push_back(cloud.positions[point].cast<double>());
    part->centroid += positions.back();
  }
  const auto size = static_cast<double>(points.size());
  part->centroid /= size;
  part->num_points = points.size();
  part->box = FitOrientedBox(positions);
  part->area = whole.area * size / static_cast<double>(whole.num_points);
}

}  // namespace

SegmentId MakeSegment(std::span<const std::uint32_t> points,
                      SegmentId from,
                      const MapCloud& cloud,
                      Segmentation* segmentation) {
  const auto id = static_cast<SegmentId>(segmentation->segments.size() + 1);
  for (const std::uint32_t point : points) segmentation->segment_of_point[point] = id;
  std::vector<std::uint32_t> rest;
  for (std::size_t i = 0; i < segmentation->segment_of_point.size(); ++i) {
    if (segmentation->segment_of_point[i] == from) rest.push_back(static_cast<std::uint32_t>(i));
  }
  SEMSLAM_CHECK(!points.empty() && !rest.empty()) << points.size() << " of segment " << from;

  const Segment whole = segmentation->segments[from - 1];
  for (const SegmentId neighbour : whole.neighbours) {
    segmentation->segments[neighbour - 1].neighbours.push_back(id);
  }
  Segment part = whole;
  part.id = id;
  part.plane.reset();
  part.is_structural = false;
  part.neighbours.insert(std::lower_bound(part.neighbours.begin(), part.neighbours.end(), from),
                         from);
  Measure(points, whole, cloud, &part);
  Segment& remaining = segmentation->segments[from - 1];
  remaining.neighbours.push_back(id);
  Measure(rest, whole, cloud, &remaining);
  segmentation->segments.push_back(std::move(part));
  return id;
}

}  // namespace semslam

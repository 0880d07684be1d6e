// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/segment_parts.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "semslam/base/check.h"

#include "semantics/segment_points.h"

namespace semslam {
namespace {

// Sets what depends on the points, but for the area.
void Measure(std::span<const std::uint32_t> points, const MapCloud& cloud, Segment* segment) {
  const std::vector<Eigen::Vector3d> positions = PositionsOf(points, cloud);
  segment->centroid.setZero();
  for (const Eigen::Vector3d& position : positions) segment->centroid += position;
  segment->centroid /= static_cast<double>(points.size());
  segment->num_points = points.size();
  segment->box = FitOrientedBox(positions);
}

// Of so many of a segment's points, in proportion to their number.
double AreaOf(std::size_t num_points, const Segment& whole) {
  return whole.area * static_cast<double>(num_points) / static_cast<double>(whole.num_points);
}

// Takes a part out of a segment but does not measure again what remains of that, except its area.
void MakeSegment(std::span<const std::uint32_t> points,
                 SegmentId from,
                 const MapCloud& cloud,
                 Segmentation* segmentation) {
  const auto id = static_cast<SegmentId>(segmentation->segments.size() + 1);
  for (const std::uint32_t point : points) segmentation->segment_of_point[point] = id;
  Segment& whole = segmentation->segments[from - 1];
  SEMSLAM_CHECK(!points.empty() && points.size() < whole.num_points)
      << points.size() << " of segment " << from;
  Segment part = whole;
  part.id = id;
  part.plane.reset();
  part.is_structural = false;
  part.neighbours.insert(std::lower_bound(part.neighbours.begin(), part.neighbours.end(), from),
                         from);
  part.area = AreaOf(points.size(), whole);
  Measure(points, cloud, &part);
  for (const SegmentId neighbour : whole.neighbours) {
    segmentation->segments[neighbour - 1].neighbours.push_back(id);
  }
  whole.neighbours.push_back(id);
  whole.area = AreaOf(whole.num_points - points.size(), whole);
  whole.num_points -= points.size();
  segmentation->segments.push_back(std::move(part));
}

}  // namespace

void MakeSegments(std::span<const std::vector<std::uint32_t>> parts,
                  SegmentId from,
                  const MapCloud& cloud,
                  Segmentation* segmentation) {
  for (const std::vector<std::uint32_t>& points : parts) {
    MakeSegment(points, from, cloud, segmentation);
  }
  std::vector<std::uint32_t> rest;
  for (std::size_t i = 0; i < segmentation->segment_of_point.size(); ++i) {
    if (segmentation->segment_of_point[i] == from) rest.push_back(static_cast<std::uint32_t>(i));
  }
  Measure(rest, cloud, &segmentation->segments[from - 1]);
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "semslam/dense/map_cloud.h"
#include "semslam/segmentation/segmenter.h"

namespace semslam {

// The points of every segment.
class SegmentPoints {
 public:
  explicit SegmentPoints(const Segmentation& segmentation)
      : first_(segmentation.segments.size() + 2) {
    for (const SegmentId segment : segmentation.segment_of_point) ++first_[segment + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    std::vector<std::uint32_t> next = first_;  // Where the next point of each goes.
    points_.resize(segmentation.segment_of_point.size());
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      points_[next[segmentation.segment_of_point[i]]++] = i;
    }
  }

  // Numbers in the cloud, ascending.
  std::span<const std::uint32_t> Of(SegmentId segment) const {
    return std::span(points_).subspan(first_[segment], first_[segment + 1] - first_[segment]);
  }

 private:
  std::vector<std::uint32_t> first_;  // In points_, by segment; and the end.
  std::vector<std::uint32_t> points_;
};

inline std::vector<Eigen::Vector3d> PositionsOf(std::span<const std::uint32_t> points,
                                                const MapCloud& cloud) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(points.size());
  for (const std::uint32_t point : points) {
    positions.push_back(cloud.positions[point].cast<double>());
  }
  return positions;
}

}  // namespace semslam

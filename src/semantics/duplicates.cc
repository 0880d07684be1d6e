// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/duplicates.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>

namespace semslam {
namespace {

constexpr double kMargin = 0.01;         // Metres around a box.
constexpr double kMinShareInside = 0.5;  // Of the smaller object's points.

bool IsInside(const Eigen::Vector3f& point, const OrientedBox& box) {
  const Eigen::Vector3d p_box = box.T_world_box.Inverse() * point.cast<double>();
  return (p_box.cwiseAbs() - box.half_size).maxCoeff() <= kMargin;
}

std::uint32_t CountOf(const std::map<SegmentPair, std::uint32_t>& counts,
                      const SemanticObject& a,
                      const SemanticObject& b) {
  std::uint32_t most = 0;
  for (const SegmentId segment : a.segments) {
    for (const SegmentId other : b.segments) {
      const auto found = counts.find({std::min(segment, other), std::max(segment, other)});
      if (found != counts.end()) most = std::max(most, found->second);
    }
  }
  return most;
}

bool WereSeenApart(const Evidence& evidence, const SemanticObject& a, const SemanticObject& b) {
  return CountOf(evidence.num_separate_boxes, a, b) > CountOf(evidence.num_shared_boxes, a, b);
}

}  // namespace

std::vector<SegmentPair> FindDuplicates(std::span<const SemanticObject> objects,
                                        const MapCloud& cloud,
                                        const SegmentPoints& segment_points,
                                        const Evidence& evidence) {
  std::vector<SegmentPair> candidates;  // Indices of objects: the larger, the smaller.
  for (std::size_t i = 0; i < objects.size(); ++i) {
    for (std::size_t j = i + 1; j < objects.size(); ++j) {
      if (objects[i].class_id != objects[j].class_id) continue;
      if (WereSeenApart(evidence, objects[i], objects[j])) continue;
      const bool is_larger = objects[i].num_points >= objects[j].num_points;
      candidates.emplace_back(is_larger ? i : j, is_larger ? j : i);
    }
  }
  std::vector<SegmentPair> duplicates;
  for (const auto& [larger, smaller] : candidates) {
    const std::vector<SegmentId>& parts = objects[smaller].segments;
    std::size_t num_inside = 0;
    for (const SegmentId part : parts) {
      for (const std::uint32_t point : segment_points.Of(part)) {
        if (IsInside(cloud.positions[point], objects[larger].box)) ++num_inside;
      }
    }
    const auto size = static_cast<double>(objects[smaller].num_points);
    if (static_cast<double>(num_inside) < kMinShareInside * size) continue;
    duplicates.emplace_back(objects[larger].segments.front(), parts.front());
  }
  return duplicates;
}

}  // namespace semslam

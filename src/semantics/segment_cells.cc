// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/segment_cells.h"

namespace semslam {

SegmentCells::SegmentCells(SegmentId segment,
                           const MapCloud& cloud,
                           const Segmentation& segmentation) {
  std::vector<std::uint32_t> own;        // Points,
  std::vector<std::uint32_t> number_of;  // and the cell of each.
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    if (segmentation.segment_of_point[i] != segment) continue;
    const Cell cell = CellOf(cloud.positions[i]);
    // Points that follow each other in the map are mostly neighbours in space too.
    const bool is_as_before = !own.empty() && cell == CellAt(number_of.back());
    number_of.push_back(is_as_before ? number_of.back() : numbers_.Insert(cell));
    own.push_back(i);
    if (number_of.back() == contents_.size()) contents_.emplace_back();
    ++contents_[number_of.back()].size;
  }
  std::uint32_t first = 0;
  for (Content& content : contents_) {
    content.first = first;
    first += content.size;
    content.size = 0;
  }
  points_.resize(own.size());
  for (std::size_t i = 0; i < own.size(); ++i) {
    Content& content = contents_[number_of[i]];
    points_[content.first + content.size++] = own[i];
  }
}

std::vector<std::uint32_t> SegmentCells::PointsIn(std::span<const Cell> cells) const {
  std::vector<std::uint32_t> points;
  for (const Cell cell : cells) {
    const std::uint32_t number = NumberOf(cell);
    if (number == KeyNumbers::kNone) continue;
    const std::span<const std::uint32_t> own = PointsAt(number);
    points.insert(points.end(), own.begin(), own.end());
  }
  return points;
}

void SegmentCells::TakeOut(std::span<const Cell> cells) {
  for (const Cell cell : cells) {
    const std::uint32_t number = NumberOf(cell);
    if (number != KeyNumbers::kNone) contents_[number].size = 0;
  }
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "semslam/base/key_numbers.h"
#include "semslam/dense/map_cloud.h"
#include "semslam/segmentation/segmenter.h"

#include "semantics/cell.h"

namespace semslam {

// One segment's points by cell, in one array.
class SegmentCells {
 public:
  SegmentCells(SegmentId segment, const MapCloud& cloud, const Segmentation& segmentation);

  // Cells have numbers below this.
  std::size_t size() const { return contents_.size(); }
  // KeyNumbers::kNone if nothing of the segment lies there.
  std::uint32_t NumberOf(Cell cell) const {
    const std::uint32_t number = numbers_.Find(cell);
    return number == KeyNumbers::kNone || contents_[number].size == 0 ? KeyNumbers::kNone : number;
  }
  Cell CellAt(std::uint32_t number) const { return numbers_.keys()[number]; }
  // Ascending.
  std::span<const std::uint32_t> PointsAt(std::uint32_t number) const {
    return std::span(points_).subspan(contents_[number].first, contents_[number].size);
  }
  // Of all these cells, one after the other.
  std::vector<std::uint32_t> PointsIn(std::span<const Cell> cells) const;

  // Takes cells out of the segment, with all their points.
  void TakeOut(std::span<const Cell> cells);

 private:
  struct Content {
    std::uint32_t first = 0;  // In points_.
    std::uint32_t size = 0;
  };

  KeyNumbers numbers_{256};
  std::vector<Content> contents_;  // By the cells' numbers.
  std::vector<std::uint32_t> points_;
};

}  // namespace semslam

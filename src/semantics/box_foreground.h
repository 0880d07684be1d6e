// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "semslam/dense/keyframe_cloud.h"
#include "semslam/segmentation/segmenter.h"
#include "semslam/semantics/evidence.h"

namespace semslam {

// The segment that every grid cell of a keyframe's cloud shows under its present pose; 0: none.
struct SegmentImage {
  int columns = 0;
  int rows = 0;
  std::vector<SegmentId> segments;  // Row by row.

  std::size_t Cell(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

// Grid cells [first_column, last_column) x [first_row, last_row) whose pixels are inside a box.
struct CellRange {
  int first_column = 0;
  int last_column = 0;
  int first_row = 0;
  int last_row = 0;

  static CellRange Of(const ImageBox& box, int stride, int columns, int rows);
  bool empty() const { return first_column >= last_column || first_row >= last_row; }
  // The middle part, `share` of each side.
  CellRange Middle(double share) const;
};

// Cells (numbers into the segment image, which belongs to the cloud) inside the box that are
// connected in depth to its middle. `is_barrier[segment]` tells the segments that cannot belong to
// the object. Ascending.
std::vector<std::size_t> FindForeground(const KeyframeCloud& cloud,
                                        const SegmentImage& image,
                                        const CellRange& box,
                                        const std::vector<bool>& is_barrier,
                                        const EvidenceOptions& options);

}  // namespace semslam

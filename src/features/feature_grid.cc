// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/features/feature_grid.h"

#include <algorithm>

#include "semslam/features/frame.h"

namespace semslam {

FeatureGrid::FeatureGrid(std::span<const Keypoint> keypoints, const PinholeCamera::Bounds& bounds)
    : min_x_(static_cast<float>(bounds.min_x)),
      min_y_(static_cast<float>(bounds.min_y)),
      columns_per_pixel_(static_cast<float>(kColumns / (bounds.max_x - bounds.min_x))),
      rows_per_pixel_(static_cast<float>(kRows / (bounds.max_y - bounds.min_y))),
      cell_begin_(kColumns * kRows + 1, 0),
      entries_(keypoints.size()) {
  std::vector<std::int32_t> cells(keypoints.size());
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const Eigen::Vector2f& pixel = keypoints[i].pixel;
    cells[i] = RowOf(pixel.y()) * kColumns + ColumnOf(pixel.x());
    ++cell_begin_[cells[i]];
  }
  // Counts to ends; filling from the back then turns ends to begins.
  for (std::size_t c = 1; c < cell_begin_.size(); ++c) cell_begin_[c] += cell_begin_[c - 1];
  for (std::size_t i = keypoints.size(); i-- > 0;) {
    entries_[--cell_begin_[cells[i]]] = {keypoints[i].pixel, static_cast<std::int32_t>(i),
                                         keypoints[i].octave};
  }
}

std::vector<int> FeatureGrid::FindInWindow(const Eigen::Vector2f& pixel,
                                           float radius,
                                           int min_octave,
                                           int max_octave) const {
  std::vector<int> found;
  ForEachInWindow(pixel, radius, min_octave, max_octave, [&](int i) { found.push_back(i); });
  return found;
}

}  // namespace semslam

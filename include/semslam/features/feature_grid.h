// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "semslam/camera/pinhole_camera.h"

namespace semslam {

struct Keypoint;

// Finds the keypoints of a frame in a square window. 64 x 48 cells over the camera's ideal bounds;
// built once, never changed, safe to share between threads.
class FeatureGrid {
 public:
  static constexpr int kColumns = 64;
  static constexpr int kRows = 48;

  FeatureGrid() = default;  // Of no keypoints.
  FeatureGrid(std::span<const Keypoint> keypoints, const PinholeCamera::Bounds& bounds);

  // Calls visit(index) for each keypoint with |x - pixel.x| <= radius, |y - pixel.y| <= radius and
  // an octave in [min_octave, max_octave]; in an order that depends on the keypoints only.
  template <typename Visitor>
  void ForEachInWindow(const Eigen::Vector2f& pixel,
                       float radius,
                       int min_octave,
                       int max_octave,
                       Visitor&& visit) const;

  // The same as a list.
  std::vector<int> FindInWindow(const Eigen::Vector2f& pixel,
                                float radius,
                                int min_octave,
                                int max_octave) const;

 private:
  struct Entry {
    Eigen::Vector2f pixel;
    std::int32_t index;
    std::int32_t octave;
  };

  // Cell that holds the coordinate; those outside belong to the outermost cells. Monotone, so that
  // the cells between those of two coordinates hold everything between them.
  static int CellOf(float coordinate, float min, float cells_per_pixel, int num_cells) {
    const float cell = (coordinate - min) * cells_per_pixel;
    if (!(cell > 0)) return 0;
    return cell >= static_cast<float>(num_cells) ? num_cells - 1 : static_cast<int>(cell);
  }
  int ColumnOf(float x) const { return CellOf(x, min_x_, columns_per_pixel_, kColumns); }
  int RowOf(float y) const { return CellOf(y, min_y_, rows_per_pixel_, kRows); }

  float min_x_ = 0;
  float min_y_ = 0;
  float columns_per_pixel_ = 0;
  float rows_per_pixel_ = 0;
  // The entries of cell c, row by row, are [cell_begin_[c], cell_begin_[c + 1]).
  std::vector<std::int32_t> cell_begin_;
  std::vector<Entry> entries_;
};

template <typename Visitor>
void FeatureGrid::ForEachInWindow(const Eigen::Vector2f& pixel,
                                  float radius,
                                  int min_octave,
                                  int max_octave,
                                  Visitor&& visit) const {
  if (entries_.empty()) return;
  const int first_column = ColumnOf(pixel.x() - radius);
  const int last_column = ColumnOf(pixel.x() + radius);
  const int last_row = RowOf(pixel.y() + radius);
  for (int row = RowOf(pixel.y() - radius); row <= last_row; ++row) {
    // The cells of a row lie side by side, and so do their entries.
    const std::int32_t end = cell_begin_[row * kColumns + last_column + 1];
    for (std::int32_t i = cell_begin_[row * kColumns + first_column]; i < end; ++i) {
      const Entry& entry = entries_[i];
      if (entry.octave < min_octave || entry.octave > max_octave) continue;
      if (!(std::abs(entry.pixel.x() - pixel.x()) <= radius)) continue;
      if (!(std::abs(entry.pixel.y() - pixel.y()) <= radius)) continue;
      visit(static_cast<int>(entry.index));
    }
  }
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/box_foreground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace semslam {
namespace {

// First cell whose pixel centre is at or right of an edge.
int FirstCell(float edge, int stride) {
  return static_cast<int>(std::ceil((edge - 0.5F) / static_cast<float>(stride)));
}

struct DepthRange {
  float low = 0;
  float high = 0;
};

// The nearest group of depths that is about as large as the largest: the object's own, when the
// middle of the box also shows what is behind it.
DepthRange FindCoreDepth(std::vector<float>& depths) {
  constexpr double kWidth = 0.1;  // Of the depth.
  constexpr double kAboutAsLarge = 0.7;
  std::sort(depths.begin(), depths.end());
  std::vector<std::size_t> counts(depths.size());  // Depths in the group that begins with each.
  std::size_t end = 0;
  std::size_t most = 0;
  for (std::size_t begin = 0; begin < depths.size(); ++begin) {
    while (end < depths.size() && depths[end] <= depths[begin] * (1.0 + kWidth)) ++end;
    counts[begin] = end - begin;
    most = std::max(most, counts[begin]);
  }
  for (std::size_t begin = 0; begin < depths.size(); ++begin) {
    if (static_cast<double>(counts[begin]) >= kAboutAsLarge * static_cast<double>(most)) {
      return {depths[begin], depths[begin + counts[begin] - 1]};
    }
  }
  return {};
}

using Cells = std::vector<std::pair<int, int>>;  // Columns and rows.

// Of the largest patch, cells joined in depth: a smaller one is something else at about the same
// distance.
constexpr double kMinPatch = 0.4;

// Grows the foreground from the middle of a box.
class Grower {
 public:
  Grower(const SegmentImage& image,
         const CellRange& box,
         const std::vector<bool>& is_barrier,
         const EvidenceOptions& options)
      : image_(image),
        box_(box),
        is_barrier_(is_barrier),
        options_(options),
        patch_of_(static_cast<std::size_t>(box.last_column - box.first_column) *
                  static_cast<std::size_t>(box.last_row - box.first_row)) {}

  // Ascending.
  std::vector<std::size_t> Grow() {
    const std::vector<std::size_t> sizes = GrowPatches();
    if (sizes.empty()) return {};
    const auto largest = static_cast<double>(*std::max_element(sizes.begin(), sizes.end()));
    std::vector<std::size_t> cells;
    for (int row = box_.first_row; row < box_.last_row; ++row) {
      for (int column = box_.first_column; column < box_.last_column; ++column) {
        const std::uint32_t patch = patch_of_[Local(column, row)];
        if (patch == 0) continue;
        if (static_cast<double>(sizes[patch - 1]) >= kMinPatch * largest) {
          cells.push_back(image_.Cell(column, row));
        }
      }
    }
    return cells;
  }

 private:
  bool CanBelong(std::size_t cell) const {
    return image_.depth[cell] > 0 && !is_barrier_[image_.segments[cell]];
  }

  std::size_t Local(int column, int row) const {
    const auto width = static_cast<std::size_t>(box_.last_column - box_.first_column);
    return static_cast<std::size_t>(row - box_.first_row) * width +
           static_cast<std::size_t>(column - box_.first_column);
  }

  void Reach(int column, int row) {
    std::uint32_t& patch = patch_of_[Local(column, row)];
    if (patch != 0) return;
    patch = growing_;
    reached_.emplace_back(column, row);
  }

  // One from each seed that no other patch has reached; their sizes.
  std::vector<std::size_t> GrowPatches() {
    std::vector<std::size_t> sizes;
    for (const auto& [column, row] : Seeds()) {
      reached_.clear();
      growing_ = static_cast<std::uint32_t>(sizes.size()) + 1;
      Reach(column, row);
      for (std::size_t next = 0; next < reached_.size(); ++next) {
        const auto [x, y] = reached_[next];
        Spread(x, y, 1, 0);
        Spread(x, y, -1, 0);
        Spread(x, y, 0, 1);
        Spread(x, y, 0, -1);
      }
      if (!reached_.empty()) sizes.push_back(reached_.size());
    }
    return sizes;
  }

  Cells Seeds() const {
    const CellRange middle = box_.Middle(options_.core_share);
    std::vector<float> depths;
    const auto for_each = [&](const auto& visit) {
      for (int row = middle.first_row; row < middle.last_row; ++row) {
        for (int column = middle.first_column; column < middle.last_column; ++column) {
          const std::size_t cell = image_.Cell(column, row);
          if (CanBelong(cell)) visit(column, row, image_.depth[cell]);
        }
      }
    };
    for_each([&](int, int, float z) { depths.push_back(z); });
    Cells seeds;
    if (depths.empty()) return seeds;
    const DepthRange core = FindCoreDepth(depths);
    for_each([&](int column, int row, float z) {
      if (z >= core.low && z <= core.high) seeds.emplace_back(column, row);
    });
    return seeds;
  }

  // To the next cell with depth in a direction, if it continues the surface.
  void Spread(int column, int row, int step_column, int step_row) {
    const float z = image_.depth[image_.Cell(column, row)];
    for (int distance = 1; distance <= options_.max_hole + 1; ++distance) {
      const int x = column + distance * step_column;
      const int y = row + distance * step_row;
      if (x < box_.first_column || x >= box_.last_column || y < box_.first_row ||
          y >= box_.last_row) {
        return;
      }
      const std::size_t cell = image_.Cell(x, y);
      if (image_.depth[cell] <= 0) continue;
      const double allowed = options_.max_depth_step + options_.depth_step_at_1m * z * z;
      if (CanBelong(cell) && std::abs(image_.depth[cell] - z) <= allowed) Reach(x, y);
      return;
    }
  }

  const SegmentImage& image_;
  const CellRange box_;
  const std::vector<bool>& is_barrier_;
  const EvidenceOptions& options_;
  std::vector<std::uint32_t> patch_of_;  // By cell within the box; 0: not reached.
  std::uint32_t growing_ = 0;            // The patch that is growing,
  Cells reached_;                        // and its cells.
};

}  // namespace

CellRange CellRange::Of(const ImageBox& box, int stride, int columns, int rows) {
  return {std::clamp(FirstCell(box.min_x, stride), 0, columns),
          std::clamp(FirstCell(box.max_x, stride), 0, columns),
          std::clamp(FirstCell(box.min_y, stride), 0, rows),
          std::clamp(FirstCell(box.max_y, stride), 0, rows)};
}

CellRange CellRange::Middle(double share) const {
  const auto cut = [share](int first, int last) {
    return static_cast<int>((1.0 - share) / 2 * (last - first));
  };
  const int columns = cut(first_column, last_column);
  const int rows = cut(first_row, last_row);
  return {first_column + columns, last_column - columns, first_row + rows, last_row - rows};
}

std::vector<std::size_t> FindForeground(const SegmentImage& image,
                                        const CellRange& box,
                                        const std::vector<bool>& is_barrier,
                                        const EvidenceOptions& options) {
  if (box.empty()) return {};
  return Grower(image, box, is_barrier, options).Grow();
}

}  // namespace semslam

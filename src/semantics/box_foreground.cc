// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/box_foreground.h"

#include <algorithm>
#include <cmath>

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

// Of the largest patch, cells joined in depth: a smaller one is something else at about the same
// distance.
constexpr double kMinPatch = 0.4;

// Grows the foreground from the middle of a box. Works on a copy of the depth in the box, with a
// frame around it that nothing grows across, so that no step has to ask where the box ends.
class Grower {
 public:
  Grower(const KeyframeCloud& cloud,
         const SegmentImage& image,
         const CellRange& box,
         const std::vector<bool>& is_barrier,
         const EvidenceOptions& options)
      : image_(image),
        box_(box),
        options_(options),
        width_(static_cast<std::size_t>(box.last_column - box.first_column) + 2),
        depth_(width_ * (static_cast<std::size_t>(box.last_row - box.first_row) + 2), kBarrier),
        patch_of_(depth_.size()) {
    for (int row = box.first_row; row < box.last_row; ++row) {
      std::size_t local = Local(box.first_column, row);
      for (int column = box.first_column; column < box.last_column; ++column, ++local) {
        const float z = cloud.DepthAt(column, row);
        const bool may_belong = z == 0 || !is_barrier[image.segments[image.Cell(column, row)]];
        if (may_belong) depth_[local] = z;
      }
    }
  }

  // Ascending.
  std::vector<std::size_t> Grow() {
    const std::vector<std::size_t> sizes = GrowPatches();
    if (sizes.empty()) return {};
    const auto largest = static_cast<double>(*std::max_element(sizes.begin(), sizes.end()));
    std::vector<std::size_t> cells;
    for (int row = box_.first_row; row < box_.last_row; ++row) {
      std::size_t local = Local(box_.first_column, row);
      for (int column = box_.first_column; column < box_.last_column; ++column, ++local) {
        const std::uint32_t patch = patch_of_[local];
        if (patch == 0) continue;
        if (static_cast<double>(sizes[patch - 1]) >= kMinPatch * largest) {
          cells.push_back(image_.Cell(column, row));
        }
      }
    }
    return cells;
  }

 private:
  static constexpr float kBarrier = -1;

  std::size_t Local(int column, int row) const {
    return static_cast<std::size_t>(row - box_.first_row + 1) * width_ +
           static_cast<std::size_t>(column - box_.first_column + 1);
  }

  // One from each seed that no other patch has reached; their sizes.
  std::vector<std::size_t> GrowPatches() {
    std::vector<std::size_t> sizes;
    std::vector<std::size_t> reached;
    for (const std::size_t seed : Seeds()) {
      if (patch_of_[seed] != 0) continue;
      const auto patch = static_cast<std::uint32_t>(sizes.size()) + 1;
      patch_of_[seed] = patch;
      reached = {seed};
      for (std::size_t next = 0; next < reached.size(); ++next) {
        Spread(reached[next], patch, &reached);
      }
      sizes.push_back(reached.size());
    }
    return sizes;
  }

  std::vector<std::size_t> Seeds() const {
    const CellRange middle = box_.Middle(options_.core_share);
    std::vector<float> depths;
    const auto for_each = [&](const auto& visit) {
      for (int row = middle.first_row; row < middle.last_row; ++row) {
        const std::size_t first = Local(middle.first_column, row);
        const std::size_t last = Local(middle.last_column, row);
        for (std::size_t cell = first; cell < last; ++cell) {
          if (depth_[cell] > 0) visit(cell);
        }
      }
    };
    for_each([&](std::size_t cell) { depths.push_back(depth_[cell]); });
    std::vector<std::size_t> seeds;
    if (depths.empty()) return seeds;
    const DepthRange core = FindCoreDepth(depths);
    for_each([&](std::size_t cell) {
      if (depth_[cell] >= core.low && depth_[cell] <= core.high) seeds.push_back(cell);
    });
    return seeds;
  }

  // To the next cell with depth in each direction, if it continues the surface.
  void Spread(std::size_t from, std::uint32_t patch, std::vector<std::size_t>* reached) {
    const float z = depth_[from];
    const double allowed = options_.max_depth_step + options_.depth_step_at_1m * z * z;
    for (const std::size_t step : {std::size_t{1}, -std::size_t{1}, width_, -width_}) {
      std::size_t cell = from + step;
      for (int hole = 0; depth_[cell] == 0 && hole < options_.max_hole; ++hole) cell += step;
      if (patch_of_[cell] != 0 || depth_[cell] <= 0) continue;
      if (!(std::abs(depth_[cell] - z) <= allowed)) continue;
      patch_of_[cell] = patch;
      reached->push_back(cell);
    }
  }

  const SegmentImage& image_;
  const CellRange box_;
  const EvidenceOptions& options_;
  const std::size_t width_;              // Of the box and its frame,
  std::vector<float> depth_;             // by cell of which: metres, 0 for none, or kBarrier.
  std::vector<std::uint32_t> patch_of_;  // The same; 0: not reached.
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

std::vector<std::size_t> FindForeground(const KeyframeCloud& cloud,
                                        const SegmentImage& image,
                                        const CellRange& box,
                                        const std::vector<bool>& is_barrier,
                                        const EvidenceOptions& options) {
  if (box.empty()) return {};
  return Grower(cloud, image, box, is_barrier, options).Grow();
}

}  // namespace semslam

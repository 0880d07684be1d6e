// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/corners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace semslam {
namespace {

constexpr int kCellSize = 30;  // Pixels, about.

// `region` cut into cells of nearly equal size.
struct Cells {
  explicit Cells(const cv::Rect& covered)
      : region(covered),
        columns(std::max(1, covered.width / kCellSize)),
        rows(std::max(1, covered.height / kCellSize)),
        width((covered.width + columns - 1) / columns),
        height((covered.height + rows - 1) / rows) {}

  int IndexOf(const Corner& c) const {
    return (c.y - region.y) / height * columns + (c.x - region.x) / width;
  }
  // The cells [first, last) of a row.
  cv::Rect Area(int row, int first, int last) const {
    return cv::Rect(region.x + first * width, region.y + row * height, (last - first) * width,
                    height) &
           region;
  }

  cv::Rect region;
  int columns, rows, width, height;
};

}  // namespace

std::vector<Corner> DetectCorners(const cv::Mat& image,
                                  int edge,
                                  int initial_threshold,
                                  int min_threshold) {
  std::vector<Corner> corners;
  const cv::Rect region(edge, edge, image.cols - 2 * edge, image.rows - 2 * edge);
  if (region.width <= 0 || region.height <= 0) return corners;
  AppendFastCorners(image, region, initial_threshold, corners);

  const Cells cells(region);
  std::vector<bool> is_filled(static_cast<std::size_t>(cells.columns) * cells.rows, false);
  for (const Corner& c : corners) is_filled[cells.IndexOf(c)] = true;
  // Neighbouring empty cells are searched in one go.
  for (int row = 0; row < cells.rows; ++row) {
    const int begin = row * cells.columns;
    for (int first = 0, last = 0; first < cells.columns; first = last + 1) {
      last = first;
      while (last < cells.columns && !is_filled[begin + last]) ++last;
      AppendFastCorners(image, cells.Area(row, first, last), min_threshold, corners);
    }
  }
  return corners;
}

namespace {

// A node of the quadtree: the corners [first, last), all inside [x0, x1) x [y0, y1).
struct Node {
  int x0, y0, x1, y1;
  Corner* first;
  Corner* last;
  std::ptrdiff_t size() const { return last - first; }
};

// Cuts a node into its (up to four) quarters that hold corners. Those are counted, then moved,
// without a branch: which quarter comes next cannot be foreseen.
void Split(const Node& node, std::vector<Corner>& scratch, std::vector<Node>& children) {
  const int x = (node.x0 + node.x1) / 2;
  const int y = (node.y0 + node.y1) / 2;
  const auto quarter_of = [x, y](const Corner& c) {
    return 2 * static_cast<int>(c.y >= y) + static_cast<int>(c.x >= x);
  };
  scratch.assign(node.first, node.last);
  std::array<std::ptrdiff_t, 4> ends{};
  for (const Corner& c : scratch) ++ends[quarter_of(c)];
  for (int i = 1; i < 4; ++i) ends[i] += ends[i - 1];
  std::array<Corner*, 4> next = {node.first, node.first + ends[0], node.first + ends[1],
                                 node.first + ends[2]};
  for (const Corner& c : scratch) *next[quarter_of(c)]++ = c;
  const Node quarters[] = {{node.x0, node.y0, x, y, node.first, next[0]},
                           {x, node.y0, node.x1, y, next[0], next[1]},
                           {node.x0, y, x, node.y1, next[1], next[2]},
                           {x, y, node.x1, node.y1, next[2], next[3]}};
  std::copy_if(std::begin(quarters), std::end(quarters), std::back_inserter(children),
               [](const Node& quarter) { return quarter.size() > 0; });
}

// As many nodes side by side as make them about square.
std::vector<Node> MakeRoots(std::vector<Corner>& corners, const cv::Rect& region) {
  const int num_roots =
      std::max(1, static_cast<int>(std::lround(static_cast<double>(region.width) /
                                               static_cast<double>(region.height))));
  std::vector<Node> roots;
  Corner* first = corners.data();
  Corner* const end = corners.data() + corners.size();
  for (int i = 0; i < num_roots; ++i) {
    const int x0 = region.x + region.width * i / num_roots;
    const int x1 = region.x + region.width * (i + 1) / num_roots;
    Corner* const last = std::partition(first, end, [x1](const Corner& c) { return c.x < x1; });
    if (last > first) roots.push_back({x0, region.y, x1, region.y + region.height, first, last});
    first = last;
  }
  return roots;
}

bool IsStronger(const Corner& a, const Corner& b) {
  if (a.response != b.response) return a.response > b.response;
  return a.y != b.y ? a.y < b.y : a.x < b.x;
}

}  // namespace

std::vector<Corner> SpreadCorners(std::vector<Corner> corners,
                                  const cv::Rect& region,
                                  int num_wanted) {
  if (corners.size() <= static_cast<std::size_t>(num_wanted)) return corners;
  std::vector<Node> open = MakeRoots(corners, region);  // With several corners, still to be cut.
  std::vector<Node> leaves;
  std::vector<Corner> scratch;
  // All nodes of a depth are cut before those of the next; at the last depth, where not all can be,
  // those with the most corners.
  while (!open.empty() && leaves.size() + open.size() < static_cast<std::size_t>(num_wanted)) {
    std::stable_sort(open.begin(), open.end(),
                     [](const Node& a, const Node& b) { return a.size() > b.size(); });
    std::vector<Node> children;
    std::size_t next = 0;
    for (; next < open.size(); ++next) {
      const std::size_t num_nodes = leaves.size() + children.size() + open.size() - next;
      if (num_nodes >= static_cast<std::size_t>(num_wanted)) break;
      if (open[next].size() == 1) {
        leaves.push_back(open[next]);
      } else {
        Split(open[next], scratch, children);
      }
    }
    children.insert(children.end(), open.begin() + static_cast<std::ptrdiff_t>(next), open.end());
    open = std::move(children);
  }
  leaves.insert(leaves.end(), open.begin(), open.end());

  std::vector<Corner> strongest;
  strongest.reserve(leaves.size());
  for (const Node& leaf : leaves) {
    strongest.push_back(*std::min_element(leaf.first, leaf.last, IsStronger));
  }
  if (strongest.size() > static_cast<std::size_t>(num_wanted)) {  // The last cut gave up to 3 more.
    std::sort(strongest.begin(), strongest.end(), IsStronger);
    strongest.resize(num_wanted);
  }
  return strongest;
}

}  // namespace semslam

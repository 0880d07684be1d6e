// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/viewer/draw_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace semslam {

void DrawList::AddLine(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const LineStyle& style) {
  lines_.push_back({a.cast<float>(), b.cast<float>(), style});
}

void DrawList::AddPath(std::span<const Eigen::Vector3d> points, const LineStyle& style) {
  for (std::size_t i = 1; i < points.size(); ++i) AddLine(points[i - 1], points[i], style);
}

void DrawList::AddBox(const OrientedBox& box, const LineStyle& style) {
  const auto corner = [&box](int i) {
    const Eigen::Vector3d signs(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    return box.T_world_box * signs.cwiseProduct(box.half_size);
  };
  for (int i = 0; i < 8; ++i) {
    for (const int bit : {1, 2, 4}) {
      if ((i & bit) == 0) AddLine(corner(i), corner(i | bit), style);
    }
  }
}

void DrawList::AddFrustum(const Rigid3& T_world_camera,
                          double half_width,
                          double half_height,
                          double depth,
                          const LineStyle& style) {
  const auto place = [&](double x, double y) {
    return T_world_camera * Eigen::Vector3d(x * half_width * depth, y * half_height * depth, depth);
  };
  const std::array<Eigen::Vector3d, 4> corners = {place(-1, -1), place(1, -1), place(1, 1),
                                                  place(-1, 1)};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    AddLine(T_world_camera.translation, corners[i], style);
    AddLine(corners[i], corners[(i + 1) % corners.size()], style);
  }
  const Eigen::Vector3d top = place(0, -1.5);
  AddLine(place(-0.5, -1.1), top, style);
  AddLine(place(0.5, -1.1), top, style);
}

void DrawList::AddGrid(const Eigen::Vector3d& center,
                       const Eigen::Vector3d& x,
                       const Eigen::Vector3d& y,
                       double spacing,
                       int num_cells,
                       const LineStyle& style) {
  const double half = 0.5 * num_cells;
  // Cell by cell, so that each part fades by its own distance from the centre.
  const auto add = [&](double x0, double y0, double x1, double y1) {
    const double from_center = std::hypot(0.5 * (x0 + x1), 0.5 * (y0 + y1)) / std::max(half, 1.0);
    LineStyle faded = style;
    faded.alpha *= static_cast<float>(std::clamp(1.0 - from_center * from_center, 0.0, 1.0));
    if (faded.alpha < 0.01F) return;
    AddLine(center + spacing * (x0 * x + y0 * y), center + spacing * (x1 * x + y1 * y), faded);
  };
  for (int i = 0; i <= num_cells; ++i) {
    for (int j = 0; j < num_cells; ++j) {
      add(i - half, j - half, i - half, j + 1 - half);
      add(j - half, i - half, j + 1 - half, i - half);
    }
  }
}

}  // namespace semslam

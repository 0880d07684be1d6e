// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "semslam/dense/rgb.h"
#include "semslam/geometry/oriented_box.h"
#include "semslam/geometry/rigid3.h"

namespace semslam {

// How a line looks.
struct LineStyle {
  Rgb color{255, 255, 255};
  float alpha = 1;         // In [0, 1].
  float width = 1.5F;      // Pixels of the picture.
  float hidden_share = 0;  // Of alpha that is left behind points.
};

// Lines and names in the world, collected for one picture. A value; knows nothing of OpenGL.
class DrawList {
 public:
  struct Line {
    Eigen::Vector3f a;  // World, metres.
    Eigen::Vector3f b;
    LineStyle style;
  };
  struct Label {
    Eigen::Vector3d p_world;
    std::string text;
    Rgb color;
    bool is_selected = false;
  };

  void AddLine(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const LineStyle& style);
  // From each point to the next.
  void AddPath(std::span<const Eigen::Vector3d> points, const LineStyle& style);
  // The twelve edges.
  void AddBox(const OrientedBox& box, const LineStyle& style);
  // The pyramid that a camera sees, cut off at so many metres: its four edges, the image's border,
  // and a mark above the border, for up. `half_width` and `half_height` are tangents.
  void AddFrustum(const Rigid3& T_world_camera,
                  double half_width,
                  double half_height,
                  double depth,
                  const LineStyle& style);
  // A square grid about a centre; `x` and `y` are its directions, of unit length. Fades outwards.
  void AddGrid(const Eigen::Vector3d& center,
               const Eigen::Vector3d& x,
               const Eigen::Vector3d& y,
               double spacing,
               int num_cells,
               const LineStyle& style);
  void AddLabel(Label label) { labels_.push_back(std::move(label)); }

  const std::vector<Line>& lines() const { return lines_; }
  const std::vector<Label>& labels() const { return labels_; }

 private:
  std::vector<Line> lines_;
  std::vector<Label> labels_;
};

}  // namespace semslam

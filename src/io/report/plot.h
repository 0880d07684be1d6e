// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace semslam {

// A line through points; one that is not finite breaks it.
struct PlotSeries {
  std::string name;   // Of the legend, which is there if there are several series.
  std::string style;  // Class of the line in style.css.
  std::vector<Eigen::Vector2d> points;
  bool is_dots = false;  // Single points instead of a line.
};

struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  bool has_equal_axes = false;  // A metre is as long to the right as upwards.
  bool starts_at_zero = false;  // The y axis.
  std::vector<PlotSeries> series;
};

// A <figure> with a title, the plot as SVG and a legend; colours come from the page's style.
// Nothing but a sentence if there is no finite point. Of many points of a line the extremes of each
// pixel column or so are kept.
std::string DrawPlot(const Plot& plot);

}  // namespace semslam

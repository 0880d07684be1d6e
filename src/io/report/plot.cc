// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/report/plot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/report/html.h"

namespace semslam {
namespace {

// Units of the drawing; about pixels where three plots are side by side.
constexpr double kWidth = 440;
constexpr double kLeft = 60;
constexpr double kRight = 14;
constexpr double kTop = 12;
constexpr double kBottom = 42;
constexpr double kHeight = 230;
constexpr double kSquareHeight = 380;  // Of a plot with equal axes.

struct Interval {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();

  bool is_empty() const { return min > max; }
  double size() const { return max - min; }
  void Add(double value) {
    min = std::min(min, value);
    max = std::max(max, value);
  }
  void Widen(double new_size) {
    const double center = 0.5 * (min + max);
    min = center - 0.5 * new_size;
    max = center + 0.5 * new_size;
  }
};

struct Frame {
  Interval x;
  Interval y;
  double height = kHeight;

  double Across(double value) const {
    return kLeft + (value - x.min) / x.size() * (kWidth - kLeft - kRight);
  }
  double Down(double value) const {
    return height - kBottom - (value - y.min) / y.size() * (height - kTop - kBottom);
  }
};

// 1, 2 or 5 times a power of ten, for about so many steps.
double NiceStep(double size, int num_steps) {
  const double raw = size / num_steps;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw * 0.999) return factor * power;
  }
  return 10.0 * power;
}

std::vector<double> Ticks(const Interval& range, double step) {
  std::vector<double> ticks;
  const double first = std::ceil(range.min / step - 1e-6);
  for (double k = first; k * step <= range.max + 1e-6 * step; ++k) ticks.push_back(k * step);
  return ticks;
}

std::string TickText(double value, double step) {
  const int num_decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
  const std::string text = Format("%.*f", num_decimals, std::abs(value) < 1e-9 * step ? 0 : value);
  return text[0] == '-' ? "\u2212" + text.substr(1) : text;
}

Frame FitFrame(const Plot& plot) {
  Frame frame;
  for (const PlotSeries& series : plot.series) {
    for (const Eigen::Vector2d& point : series.points) {
      if (!point.allFinite()) continue;
      frame.x.Add(point.x());
      frame.y.Add(point.y());
    }
  }
  if (frame.x.is_empty()) return frame;
  if (plot.starts_at_zero) frame.y.Add(0);
  if (!(frame.x.size() > 1e-9)) frame.x.Widen(1);
  if (!(frame.y.size() > 1e-9)) frame.y.Widen(plot.has_equal_axes ? 1e-6 : 1);
  if (plot.has_equal_axes) {
    frame.height = kSquareHeight;
    const double aspect = (kWidth - kLeft - kRight) / (frame.height - kTop - kBottom);
    const double across = 1.1 * std::max(frame.x.size(), frame.y.size() * aspect);
    frame.x.Widen(across);
    frame.y.Widen(across / aspect);
    return frame;
  }
  const double bottom = frame.y.min;
  frame.y.Widen(1.08 * frame.y.size());
  if (plot.starts_at_zero && bottom >= 0) frame.y.min = 0;
  return frame;
}

std::string DrawAxes(const Plot& plot, const Frame& frame) {
  std::string svg;
  const double x_step = NiceStep(frame.x.size(), 6);
  const double y_step =
      plot.has_equal_axes ? x_step : NiceStep(frame.y.size(), frame.height > kHeight ? 7 : 4);
  const double right = kWidth - kRight;
  const double bottom = frame.height - kBottom;
  for (const double tick : Ticks(frame.y, y_step)) {
    const double y = frame.Down(tick);
    svg += Format("<path class=\"grid\" d=\"M%.1f %.1fH%.1f\"/>", kLeft, y, right);
    svg += Format("<text class=\"tick\" x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">%s</text>",
                  kLeft - 6, y + 4, TickText(tick, y_step).c_str());
  }
  for (const double tick : Ticks(frame.x, x_step)) {
    const double x = frame.Across(tick);
    if (plot.has_equal_axes) {
      svg += Format("<path class=\"grid\" d=\"M%.1f %.1fV%.1f\"/>", x, kTop, bottom);
    } else {
      svg += Format("<path class=\"axis\" d=\"M%.1f %.1fv4\"/>", x, bottom);
    }
    svg += Format("<text class=\"tick\" x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%s</text>", x,
                  bottom + 17, TickText(tick, x_step).c_str());
  }
  svg += Format("<path class=\"axis\" d=\"M%.1f %.1fV%.1fH%.1f\"/>", kLeft, kTop, bottom, right);
  svg += Format("<text class=\"label\" x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%s</text>",
                0.5 * (kLeft + right), frame.height - 6, EscapeHtml(plot.x_label).c_str());
  svg += Format(
      "<text class=\"label\" transform=\"translate(11 %.1f) rotate(-90)\" "
      "text-anchor=\"middle\">%s</text>",
      0.5 * (kTop + bottom), EscapeHtml(plot.y_label).c_str());
  return svg;
}

bool IsLowerAcross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.y() < b.y(); }

// The lowest and the highest of each group of points, in their order. Breaks stay.
std::vector<Eigen::Vector2d> Thin(const std::vector<Eigen::Vector2d>& points) {
  constexpr std::size_t kMaxPoints = 1200;
  if (points.size() <= kMaxPoints) return points;
  const std::size_t group = (points.size() + kMaxPoints / 2 - 1) / (kMaxPoints / 2);
  std::vector<Eigen::Vector2d> kept;
  for (std::size_t begin = 0; begin < points.size(); begin += group) {
    const auto first = points.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last =
        points.begin() + static_cast<std::ptrdiff_t>(std::min(points.size(), begin + group));
    const auto broken =
        std::find_if(first, last, [](const auto& point) { return !point.allFinite(); });
    if (broken != last) {
      kept.insert(kept.end(), first, last);
      continue;
    }
    const auto [low, high] = std::minmax_element(first, last, IsLowerAcross);
    kept.push_back(*std::min(low, high));
    if (low != high) kept.push_back(*std::max(low, high));
  }
  return kept;
}

// As many points, evenly; for lines in the plane, where low and high mean nothing.
std::vector<Eigen::Vector2d> ThinEvenly(const std::vector<Eigen::Vector2d>& points) {
  constexpr std::size_t kMaxPoints = 3000;
  const std::size_t step = (points.size() + kMaxPoints - 1) / kMaxPoints;
  if (step <= 1) return points;
  std::vector<Eigen::Vector2d> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % step == 0 || i + 1 == points.size() || !points[i].allFinite())
      kept.push_back(points[i]);
  }
  return kept;
}

std::string DrawSeries(const PlotSeries& series, const Plot& plot, const Frame& frame) {
  std::string path;
  bool is_connected = false;
  const auto points = plot.has_equal_axes ? ThinEvenly(series.points) : Thin(series.points);
  for (const Eigen::Vector2d& point : points) {
    if (!point.allFinite()) {
      is_connected = false;
      continue;
    }
    path += Format("%c%.1f %.1f", is_connected ? 'L' : 'M', frame.Across(point.x()),
                   frame.Down(point.y()));
    if (series.is_dots) path += "h0";
    is_connected = !series.is_dots;
  }
  return "<path class=\"line " + series.style + (series.is_dots ? " dots" : "") + "\" d=\"" + path +
         "\"/>";
}

std::string DrawLegend(const Plot& plot) {
  if (plot.series.size() < 2) return "";
  std::string html = "<figcaption class=\"keys\">";
  for (const PlotSeries& series : plot.series) {
    html +=
        "<span><svg class=\"key\" viewBox=\"0 0 22 10\" aria-hidden=\"true\"><path class=\"line " +
        series.style + (series.is_dots ? " dots\" d=\"M11 5h0\"" : "\" d=\"M1 5H21\"") +
        "/></svg>" + EscapeHtml(series.name) + "</span>";
  }
  return html + "</figcaption>";
}

}  // namespace

std::string DrawPlot(const Plot& plot) {
  const std::string title = EscapeHtml(plot.title);
  std::string html =
      plot.has_equal_axes ? "<figure class=\"plot tall\">" : "<figure class=\"plot\">";
  html += "<h3>" + title + "</h3>";
  const Frame frame = FitFrame(plot);
  if (frame.x.is_empty()) return html + "<p class=\"muted\">Nothing was recorded.</p></figure>\n";
  html +=
      Format("<svg viewBox=\"0 0 %.0f %.0f\" role=\"img\" aria-label=\"", kWidth, frame.height) +
      title + "\">";
  html += DrawAxes(plot, frame);
  for (const PlotSeries& series : plot.series) html += DrawSeries(series, plot, frame);
  return html + "</svg>" + DrawLegend(plot) + "</figure>\n";
}

}  // namespace semslam

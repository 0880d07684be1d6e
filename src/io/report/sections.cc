// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/report/sections.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "io/report/html.h"
#include "io/report/plot.h"

namespace semslam {
namespace {

std::string JpegUri(const std::string& jpeg) { return "data:image/jpeg;base64," + Base64(jpeg); }

const ClassRecord* FindClass(const LabelledMapView& map, std::uint32_t label) {
  const auto entry = std::find_if(map.classes.begin(), map.classes.end(),
                                  [&](const ClassRecord& c) { return c.label == label; });
  return entry == map.classes.end() ? nullptr : &*entry;
}

std::string ClassName(const LabelledMapView& map, std::uint32_t label) {
  const ClassRecord* entry = FindClass(map, label);
  return EscapeHtml(entry == nullptr ? "class " + std::to_string(label) : entry->name);
}

std::string Tile(const ReportFact& fact, const char* style) {
  return std::string("<div class=\"") + style + "\"><strong>" + EscapeHtml(fact.value) +
         "</strong><span>" + EscapeHtml(fact.name) + "</span></div>\n";
}

std::string ObjectRow(const LabelledMapView& map, std::size_t place, const std::string& picture) {
  const ObjectRecord& object = map.objects[place];
  const ClassRecord* entry = FindClass(map, object.label);
  const std::string name = ClassName(map, object.label);
  const std::string number = std::to_string(object.id);
  std::string row = "<tr data-object=\"" + std::to_string(place) + "\"><td><button class=\"fly\" " +
                    "type=\"button\" aria-label=\"Show " + name + " " + number + " in the map\">";
  row += picture.empty()
             ? "<span class=\"no-picture\">no picture</span>"
             : "<img alt=\"\" width=\"192\" height=\"144\" src=\"" + JpegUri(picture) + "\"/>";
  row += "</button></td><th scope=\"row\"><span class=\"chip\" style=\"background:" +
         HexColor(entry == nullptr ? kNoClassColor : entry->color) + "\"></span>" + name +
         " <small>#" + number + "</small></th>";
  const double percent = 100.0 * std::clamp(object.confidence, 0.0, 1.0);
  row += Format(
      "<td class=\"num\"><span class=\"bar\"><i style=\"width:%.0f%%\"></i></span>%.0f %%</td>",
      percent, percent);
  row += "<td class=\"num\">" + GroupDigits(object.num_views) + "</td><td class=\"num wide\">" +
         GroupDigits(object.num_points) + "</td>";
  const Eigen::Vector3d size = 200.0 * object.box.half_size;
  row += Format("<td class=\"num no-phone\">%.0f \u00D7 %.0f \u00D7 %.0f</td>", size.x(), size.y(),
                size.z());
  row += Format("<td class=\"num wide\">%.2f, %.2f, %.2f</td></tr>\n", object.centroid.x(),
                object.centroid.y(), object.centroid.z());
  return row;
}

std::string DrawBoxes(const ReportData& data, const ReportKeyframe& keyframe) {
  constexpr std::size_t kMaxBoxes = 15;
  constexpr double kFont = 22;  // Pixels of the recorded image.
  std::string svg;
  std::size_t num_boxes = 0;
  for (const Detection& detection : keyframe.detections) {
    const auto label = static_cast<std::uint32_t>(detection.class_id + 1);
    const ClassRecord* entry = FindClass(data.map, label);
    if (entry == nullptr || num_boxes++ == kMaxBoxes) continue;
    const std::string color = HexColor(entry->color);
    const ImageBox& box = detection.box;
    svg += Format(
        "<rect class=\"box\" x=\"%.0f\" y=\"%.0f\" width=\"%.0f\" height=\"%.0f\" "
        "stroke=\"%s\"/>",
        box.min_x, box.min_y, box.width(), box.height(), color.c_str());
    const std::string text =
        entry->name.substr(0, 40) + Format(" %.2f", static_cast<double>(detection.score));
    const double width = 0.56 * kFont * static_cast<double>(text.size()) + 8;
    const double x = std::clamp<double>(box.min_x, 0, std::max(0.0, data.camera.width - width));
    const double y = std::max<double>(box.min_y, kFont + 6);
    const Rgb& c = entry->color;
    const bool is_bright = 0.3 * c.r + 0.59 * c.g + 0.11 * c.b > 128;
    svg += Format("<rect x=\"%.0f\" y=\"%.0f\" width=\"%.0f\" height=\"%.0f\" fill=\"%s\"/>", x,
                  y - kFont - 6, width, kFont + 6, color.c_str());
    svg += Format("<text x=\"%.0f\" y=\"%.0f\" font-size=\"%.0f\" fill=\"%s\">", x + 4, y - 7,
                  kFont, is_bright ? "#000" : "#fff") +
           EscapeHtml(text) + "</text>";
  }
  return svg;
}

// Seconds since the start of the run.
class Clock {
 public:
  explicit Clock(const Trajectory& trajectory)
      : start_(trajectory.empty() ? 0 : trajectory.front().time) {}
  double operator()(TimeNs time) const { return ToSeconds(time - start_); }

 private:
  TimeNs start_;
};

Eigen::Vector2d Break() {
  return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
}

// Points of a timed sequence, with a break where it has a gap.
template <typename Sequence, typename PointOf>
std::vector<Eigen::Vector2d> Trace(const Sequence& sequence, PointOf point_of) {
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    if (i > 0 && IsGap(sequence[i - 1].time, sequence[i].time)) points.push_back(Break());
    points.push_back(point_of(sequence[i]));
  }
  return points;
}

// A line of the estimated positions, and one of the true ones if they are known.
template <typename PointOf>
std::vector<PlotSeries> EstimateAndTruth(const ReportData& data, PointOf point_of) {
  std::vector<PlotSeries> series;
  if (data.accuracy) {
    series.push_back({"truth", "truth", Trace(data.accuracy->poses, [&](const auto& pose) {
                        return point_of(pose.time, pose.position);
                      })});
  }
  series.push_back({"estimate", "estimate", Trace(data.trajectory, [&](const TimedPose& pose) {
                      return point_of(pose.time, pose.T_world_camera.translation);
                    })});
  return series;
}

std::string PlotFromAbove(const ReportData& data, const LevelFrame& level) {
  const auto from_above = [&](TimeNs, const Eigen::Vector3d& p) {
    return Eigen::Vector2d(level.right.dot(p), level.forward.dot(p));
  };
  Plot plot{.title = "From above",
            .x_label = "to the right of the first camera (m)",
            .y_label = "forward (m)",
            .has_equal_axes = true,
            .series = EstimateAndTruth(data, from_above)};
  PlotSeries keyframes{"keyframes", "keyframes", {}, true};
  for (const ReportKeyframe& keyframe : data.keyframes)
    keyframes.points.push_back(from_above(0, keyframe.T_world_camera.translation));
  if (!keyframes.points.empty()) plot.series.push_back(std::move(keyframes));
  return DrawPlot(plot);
}

}  // namespace

std::string HighlightTiles(const ReportData& data) {
  std::string html;
  for (const ReportFact& fact : data.highlights) html += Tile(fact, "tile");
  if (data.speed.highlight) html += Tile(*data.speed.highlight, "tile measured");
  return html;
}

std::string NoteList(const std::vector<std::string>& notes) {
  if (notes.empty()) return "";
  std::string html = "<ul class=\"notes\">";
  for (const std::string& note : notes) html += "<li>" + EscapeHtml(note) + "</li>";
  return html + "</ul>\n";
}

std::string FactTable(const std::vector<ReportFact>& facts) {
  if (facts.empty()) return "";
  std::string html = "<table class=\"facts\"><tbody>\n";
  for (const ReportFact& fact : facts) {
    html += "<tr><th scope=\"row\">" + EscapeHtml(fact.name) + "</th><td>" +
            EscapeHtml(fact.value) + "</td></tr>\n";
  }
  return html + "</tbody></table>\n";
}

std::string ObjectTable(const LabelledMapView& map,
                        const std::vector<std::string>& pictures,
                        std::size_t max_rows) {
  if (map.objects.empty()) return "<p class=\"muted\">No object was found.</p>\n";
  std::vector<std::size_t> order(map.objects.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return map.objects[a].confidence > map.objects[b].confidence;
  });
  if (order.size() > max_rows) order.resize(max_rows);
  std::string html =
      "<div class=\"scroll\"><table class=\"objects\"><thead><tr><td></td><th>object</th>"
      "<th class=\"num\">confidence</th><th class=\"num\">views</th><th class=\"num "
      "wide\">points"
      "</th><th class=\"num no-phone\">size (cm)</th><th class=\"num wide\">position "
      "(m)</th></tr></thead>"
      "<tbody>\n";
  for (const std::size_t place : order) html += ObjectRow(map, place, pictures[place]);
  html += "</tbody></table></div>\n";
  if (order.size() < map.objects.size()) {
    html += "<p class=\"muted\">" + std::to_string(map.objects.size() - order.size()) +
            " more are in objects.json.</p>\n";
  }
  return html;
}

std::string KeyframeStrip(const ReportData& data, const std::vector<StripPicture>& pictures) {
  if (pictures.empty()) return "<p class=\"muted\">There are no pictures of keyframes.</p>\n";
  const Clock clock(data.trajectory);
  std::string html = "<div class=\"strip\">\n";
  for (const StripPicture& picture : pictures) {
    const ReportKeyframe& keyframe = data.keyframes[picture.keyframe];
    const std::string time = Format("%.2f s", clock(keyframe.time));
    html += "<button class=\"keyframe\" type=\"button\" data-keyframe=\"";
    html += std::to_string(picture.keyframe);
    html += "\" aria-label=\"Look from the keyframe at " + time;
    html += "\"><span class=\"picture\"><img alt=\"\" src=\"" + JpegUri(picture.jpeg) + "\"/>";
    html += Format("<svg viewBox=\"0 0 %d %d\" aria-hidden=\"true\">", data.camera.width,
                   data.camera.height);
    html += DrawBoxes(data, keyframe);
    html += "</svg></span><span>" + time + "</span></button>\n";
  }
  html += "</div>\n";
  if (pictures.size() < data.keyframes.size()) {
    html += Format("<p class=\"muted\">%zu of %zu keyframes.</p>\n", pictures.size(),
                   data.keyframes.size());
  }
  return html;
}

std::string TrajectoryPlots(const ReportData& data, const LevelFrame& level) {
  const Clock clock(data.trajectory);
  std::string html = PlotFromAbove(data, level);
  if (data.accuracy) {
    PlotSeries errors{"error", "error", Trace(data.accuracy->poses, [&](const auto& pose) {
                        return Eigen::Vector2d(clock(pose.time), 1e3 * pose.error);
                      })};
    html += DrawPlot({.title = "Distance from the truth",
                      .x_label = "time (s)",
                      .y_label = "error (mm)",
                      .starts_at_zero = true,
                      .series = {std::move(errors)}});
  }
  constexpr const char* kAxes[] = {"x: to the right", "y: downwards", "z: forward"};
  for (int axis = 0; axis < 3; ++axis) {
    html += DrawPlot({.title = kAxes[axis],
                      .x_label = "time (s)",
                      .y_label = "position (m)",
                      .series = EstimateAndTruth(data, [&](TimeNs time, const Eigen::Vector3d& p) {
                        return Eigen::Vector2d(clock(time), p[axis]);
                      })});
  }
  return html;
}

std::string SpeedPlots(const ReportSpeed& speed) {
  PlotSeries tracking{"tracking", "estimate", {}};
  for (std::size_t i = 0; i < speed.tracking_milliseconds.size(); ++i)
    tracking.points.emplace_back(i, speed.tracking_milliseconds[i]);
  std::string html = DrawPlot({.title = "Tracking time of each frame",
                               .x_label = "frame",
                               .y_label = "time (ms)",
                               .starts_at_zero = true,
                               .series = {std::move(tracking)}});
  if (speed.queues.empty()) return html;
  using Queues = ReportSpeed::Queues;
  const auto line = [&](const char* name, const char* style, std::size_t Queues::*length) {
    PlotSeries series{name, style, {}};
    for (const Queues& queues : speed.queues)
      series.points.emplace_back(queues.frame, queues.*length);
    return series;
  };
  return html + DrawPlot({.title = "Waiting for each thread",
                          .x_label = "frame",
                          .y_label = "queue length",
                          .starts_at_zero = true,
                          .series = {line("mapping", "estimate", &Queues::mapping),
                                     line("loop closing", "error", &Queues::loop),
                                     line("dense map", "third", &Queues::dense),
                                     line("detector", "fourth", &Queues::detector)}});
}

std::string SettingsText(const std::string& text, std::size_t max_bytes) {
  if (text.size() <= max_bytes) return EscapeHtml(text);
  return EscapeHtml(text.substr(0, max_bytes)) + "\n\u2026";
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/viewer/map_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "semslam/io/segment_color.h"

#include "viewer/line_styles.h"

namespace semslam {
namespace {

constexpr LineStyle kGridStyle{
    .color = {150, 165, 185}, .alpha = 0.22F, .width = 1.0F, .hidden_share = 0};
constexpr float kHiddenBox = 0.3F;

const ClassRecord* FindClass(std::uint32_t label, std::span<const ClassRecord> classes) {
  const auto entry = std::find_if(classes.begin(), classes.end(),
                                  [label](const ClassRecord& c) { return c.label == label; });
  return entry == classes.end() ? nullptr : &*entry;
}

// A spacing of 1, 2 or 5 times a power of ten that cuts the extent into about ten.
double GridSpacing(double extent) {
  const double rough = std::max(extent, 1e-3) / 10;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * power >= rough) return step * power;
  }
  return 10 * power;
}

void AddFloor(const MapScene& scene, const LevelFrame& level, DrawList* list) {
  const std::span<const Eigen::Vector3f> points = scene.map.cloud.positions;
  if (points.empty()) return;
  const HeightRange heights = FindHeightRange(points, level.up);
  const HeightRange right = FindHeightRange(points, level.right);
  const HeightRange forward = FindHeightRange(points, level.forward);
  const double extent = std::max({right.high - right.low, forward.high - forward.low, 0.1});
  const double spacing = GridSpacing(1.6 * extent);
  const auto snap = [spacing](double a, double b) {
    return spacing * std::round(0.5 * (a + b) / spacing);
  };
  const Eigen::Vector3d center = heights.low * level.up +
                                 snap(right.low, right.high) * level.right +
                                 snap(forward.low, forward.high) * level.forward;
  const int num_cells = 2 * static_cast<int>(std::ceil(extent / spacing)) + 2;
  list->AddGrid(center, level.right, level.forward, spacing, num_cells, kGridStyle);
}

void AddTrajectory(const MapScene& scene, DrawList* list) {
  // Where the camera was lost for so long, there is no line.
  constexpr TimeNs kGap = kNsPerSecond / 2;
  for (std::size_t i = 1; i < scene.trajectory.size(); ++i) {
    const TimedPose& a = scene.trajectory[i - 1];
    const TimedPose& b = scene.trajectory[i];
    if (b.time - a.time <= kGap)
      list->AddLine(a.T_world_camera.translation, b.T_world_camera.translation, kTrajectoryStyle);
  }
  double half_width = 0.6;
  double half_height = 0.45;
  if (scene.camera && scene.camera->fx > 0 && scene.camera->fy > 0) {
    half_width = 0.5 * scene.camera->width / scene.camera->fx;
    half_height = 0.5 * scene.camera->height / scene.camera->fy;
  }
  constexpr double kDepth = 0.06;  // Metres.
  for (const TimedPose& keyframe : scene.keyframes)
    list->AddFrustum(keyframe.T_world_camera, half_width, half_height, kDepth, kKeyframeStyle);
}

// Above the middle of a box, as high as its highest corner.
Eigen::Vector3d TopOf(const OrientedBox& box, const Eigen::Vector3d& up) {
  const Eigen::Vector3d up_box = box.T_world_box.rotation.conjugate() * up;
  return box.T_world_box.translation + up_box.cwiseAbs().dot(box.half_size) * up;
}

void AddObjects(const MapScene& scene,
                const LevelFrame& level,
                const OverlayOptions& options,
                DrawList* list) {
  for (const ObjectRecord& object : scene.map.objects) {
    const bool is_selected = options.selected_object == object.id;
    const Rgb color = ObjectColor(object, scene.map.classes);
    list->AddBox(object.box, {.color = color,
                              .alpha = 1.0F,
                              .width = is_selected ? 3.0F : 1.8F,
                              .hidden_share = is_selected ? 0.6F : kHiddenBox});
    list->AddLabel(
        {TopOf(object.box, level.up), ObjectTitle(object, scene.map.classes), color, is_selected});
  }
}

}  // namespace

HeightRange FindHeightRange(std::span<const Eigen::Vector3f> points, const Eigen::Vector3d& up) {
  constexpr std::size_t kMaxPoints = 50000;
  constexpr double kOutside = 0.005;  // Share of the points at either end.
  const Eigen::Vector3f axis = up.cast<float>();
  std::vector<float> heights;
  const std::size_t step = std::max<std::size_t>(1, points.size() / kMaxPoints);
  for (std::size_t i = 0; i < points.size(); i += step) {
    if (points[i].allFinite()) heights.push_back(points[i].dot(axis));
  }
  if (heights.empty()) return {};
  std::sort(heights.begin(), heights.end());
  const auto last = static_cast<double>(heights.size() - 1);
  const auto at = [&](double share) { return heights[static_cast<std::size_t>(share * last)]; };
  return {at(kOutside), at(1 - kOutside)};
}

Rgb HeightColor(double share) {
  static constexpr std::array<std::array<double, 3>, 6> kStops = {{{54, 62, 150},
                                                                   {38, 116, 190},
                                                                   {28, 168, 168},
                                                                   {84, 194, 104},
                                                                   {190, 214, 70},
                                                                   {252, 220, 96}}};
  const double place = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(place), kStops.size() - 2);
  const double t = place - static_cast<double>(low);
  const auto mix = [&](std::size_t i) {
    return static_cast<std::uint8_t>(
        std::lround((1 - t) * kStops[low][i] + t * kStops[low + 1][i]));
  };
  return {mix(0), mix(1), mix(2)};
}

std::vector<Rgb> PointColors(const LabelledMapView& map,
                             ColorMode mode,
                             const Eigen::Vector3d& up,
                             const HeightRange& heights) {
  constexpr Rgb kNoColor{200, 200, 200};
  const CloudView& cloud = map.cloud;
  const std::size_t size = cloud.positions.size();
  std::vector<Rgb> colors;
  switch (mode) {
    case ColorMode::kPhoto:
      if (cloud.colors.empty()) return std::vector<Rgb>(size, kNoColor);
      return {cloud.colors.begin(), cloud.colors.end()};
    case ColorMode::kClasses:
      return SemanticColors(map);
    case ColorMode::kSegments:
      if (cloud.segments.empty()) return std::vector<Rgb>(size, SegmentColor(0));
      colors.reserve(size);
      for (const std::uint32_t segment : cloud.segments) colors.push_back(SegmentColor(segment));
      return colors;
    case ColorMode::kHeight:
      break;
  }
  const double range = std::max(heights.high - heights.low, 1e-6);
  colors.reserve(size);
  for (const Eigen::Vector3f& p : cloud.positions) {
    const double height = p.cast<double>().dot(up);
    colors.push_back(HeightColor((height - heights.low) / range));
  }
  return colors;
}

std::vector<Eigen::Vector3f> PointsToShow(const MapScene& scene, const OverlayOptions& options) {
  constexpr std::size_t kMaxPoints = 20000;
  constexpr double kShareOfKeyframes = 0.3;
  const std::span<const Eigen::Vector3f> cloud = scene.map.cloud.positions;
  const std::size_t step = std::max<std::size_t>(1, cloud.size() / kMaxPoints);
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < cloud.size(); i += step) {
    if (cloud[i].allFinite()) points.push_back(cloud[i]);
  }
  if (!options.trajectory || scene.keyframes.empty()) return points;
  const auto wanted =
      static_cast<std::size_t>(kShareOfKeyframes * static_cast<double>(points.size()));
  const std::size_t num_copies = 1 + wanted / scene.keyframes.size();
  for (const TimedPose& keyframe : scene.keyframes)
    points.insert(points.end(), num_copies, keyframe.T_world_camera.translation.cast<float>());
  return points;
}

DrawList MakeOverlay(const MapScene& scene,
                     const LevelFrame& level,
                     const OverlayOptions& options) {
  DrawList list;
  if (options.grid) AddFloor(scene, level, &list);
  if (options.trajectory) AddTrajectory(scene, &list);
  if (options.objects) AddObjects(scene, level, options, &list);
  return list;
}

std::optional<std::uint32_t> PickObject(std::span<const ObjectRecord> objects,
                                        const Eigen::Vector3d& origin,
                                        const Eigen::Vector3d& direction) {
  std::optional<std::uint32_t> picked;
  double nearest = std::numeric_limits<double>::infinity();
  for (const ObjectRecord& object : objects) {
    // Where the ray is between each pair of opposite faces; in all of them, it is inside.
    const Rigid3 T_box_world = object.box.T_world_box.Inverse();
    const Eigen::Array3d from = T_box_world * origin;
    const Eigen::Array3d along = T_box_world.rotation * direction;
    const Eigen::Array3d low = (-object.box.half_size.array() - from) / along;
    const Eigen::Array3d high = (object.box.half_size.array() - from) / along;
    const double enters = low.min(high).maxCoeff();
    const double leaves = low.max(high).minCoeff();
    if (!(leaves >= std::max(enters, 0.0)) || enters >= nearest) continue;
    nearest = enters;
    picked = object.id;
  }
  return picked;
}

std::string ObjectTitle(const ObjectRecord& object, std::span<const ClassRecord> classes) {
  const ClassRecord* entry = FindClass(object.label, classes);
  const std::string name = entry == nullptr ? "object" : entry->name;
  return name + " " + std::to_string(std::lround(100 * object.confidence)) + " %";
}

Rgb ObjectColor(const ObjectRecord& object, std::span<const ClassRecord> classes) {
  const ClassRecord* entry = FindClass(object.label, classes);
  return entry == nullptr ? Rgb{255, 255, 255} : entry->color;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/report/scene_json.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <nlohmann/json.hpp>

#include "io/report/html.h"

namespace semslam {
namespace {

// In quotes; nothing in it can end a script element.
std::string JsonText(const std::string& text) {
  std::string json =
      nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos; at += 6)
    json.replace(at, 1, "\\u003c");
  return json;
}

std::string JsonNumber(double value) { return Format("%.4f", std::isfinite(value) ? value : 0.0); }

std::string JsonVector(const Eigen::Vector3d& v) {
  return "[" + JsonNumber(v.x()) + "," + JsonNumber(v.y()) + "," + JsonNumber(v.z()) + "]";
}

// Rows one after the other.
std::string JsonMatrix(const Eigen::Matrix3d& m) {
  std::string json = "[";
  for (int i = 0; i < 9; ++i) json += (i == 0 ? "" : ",") + JsonNumber(m(i / 3, i % 3));
  return json + "]";
}

std::string Join(const std::vector<std::string>& items) {
  std::string json = "[";
  for (const std::string& item : items) json += (json.size() == 1 ? "" : ",") + item;
  return json + "]";
}

std::string JsonClasses(const LabelledMapView& map) {
  std::vector<std::string> classes;
  for (const ClassRecord& entry : map.classes) {
    classes.push_back("{\"name\":" + JsonText(entry.name) + ",\"color\":\"" +
                      HexColor(entry.color) + "\"}");
  }
  return Join(classes);
}

std::string JsonObjects(const ReportData& data,
                        const std::vector<std::optional<ObjectView>>& views) {
  std::map<std::uint32_t, std::size_t> place_of_label;
  for (std::size_t i = 0; i < data.map.classes.size(); ++i)
    place_of_label.emplace(data.map.classes[i].label, i + 1);
  std::vector<std::string> objects;
  for (std::size_t i = 0; i < data.map.objects.size(); ++i) {
    const ObjectRecord& object = data.map.objects[i];
    const auto place = place_of_label.find(object.label);
    std::string json =
        "{\"id\":" + std::to_string(object.id) +
        ",\"class\":" + std::to_string(place == place_of_label.end() ? 0 : place->second) +
        ",\"confidence\":" + JsonNumber(object.confidence) +
        ",\"center\":" + JsonVector(object.box.T_world_box.translation) +
        ",\"axes\":" + JsonMatrix(object.box.T_world_box.rotation.toRotationMatrix()) +
        ",\"half\":" + JsonVector(object.box.half_size);
    if (views[i]) {
      const ReportKeyframe& keyframe = data.keyframes[views[i]->keyframe];
      json += ",\"eye\":" + JsonVector(keyframe.T_world_camera.translation);
    }
    objects.push_back(json + "}");
  }
  return Join(objects);
}

std::string JsonPath(const Trajectory& trajectory) {
  constexpr std::size_t kMaxPoses = 3000;
  const std::size_t step = trajectory.size() / kMaxPoses + 1;
  std::vector<std::string> lines;
  std::vector<std::string> line;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    if (i > 0 && IsGap(trajectory[i - 1].time, trajectory[i].time)) {
      lines.push_back(Join(line));
      line.clear();
    }
    if (i % step == 0 || i + 1 == trajectory.size())
      line.push_back(JsonVector(trajectory[i].T_world_camera.translation));
  }
  lines.push_back(Join(line));
  return Join(lines);
}

std::string JsonKeyframes(const std::vector<ReportKeyframe>& keyframes) {
  std::vector<std::string> list;
  for (const ReportKeyframe& keyframe : keyframes) {
    const Rigid3& T_world_camera = keyframe.T_world_camera;
    list.push_back("{\"position\":" + JsonVector(T_world_camera.translation) +
                   ",\"axes\":" + JsonMatrix(T_world_camera.rotation.toRotationMatrix()) + "}");
  }
  return Join(list);
}

}  // namespace

std::string HexColor(Rgb color) {
  return Format("#%02x%02x%02x", unsigned{color.r}, unsigned{color.g}, unsigned{color.b});
}

bool IsGap(TimeNs before, TimeNs after) { return after - before > kNsPerSecond / 2; }

std::string SceneJson(const ReportData& data,
                      const LevelFrame& level,
                      const PackedPoints& points,
                      const std::vector<std::optional<ObjectView>>& object_views) {
  const double aspect = 1.0 * data.camera.width / std::max(1, data.camera.height);
  const double fov = data.camera.fy > 0 ? 0.5 * data.camera.height / data.camera.fy : 0.45;
  return "{\"points\":" + std::to_string(points.num_points) + ",\"low\":" + JsonVector(points.low) +
         Format(",\"step\":%.9g,\"spacing\":%.6g", points.step, points.spacing) +
         ",\"right\":" + JsonVector(level.right) + ",\"forward\":" + JsonVector(level.forward) +
         ",\"up\":" + JsonVector(level.up) + ",\"aspect\":" + JsonNumber(aspect) +
         ",\"tangent\":" + JsonNumber(fov) + ",\"classes\":" + JsonClasses(data.map) +
         ",\"objects\":" + JsonObjects(data, object_views) +
         ",\"path\":" + JsonPath(data.trajectory) +
         ",\"keyframes\":" + JsonKeyframes(data.keyframes) + "}";
}

}  // namespace semslam

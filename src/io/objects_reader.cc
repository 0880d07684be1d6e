// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <limits>
#include <set>

#include "semslam/io/objects_io.h"

#include "io/json_fields.h"

namespace semslam {
namespace {

constexpr std::uint64_t kMaxId = std::numeric_limits<std::uint32_t>::max();

std::uint8_t ToChannel(double value) { return static_cast<std::uint8_t>(value); }

ClassRecord ToClass(const JsonField& json) {
  ClassRecord record;
  record.label = static_cast<std::uint32_t>(json["label"].Unsigned(kMaxId));
  record.name = json["name"].String();
  const Eigen::Vector3d color = json["color_rgb"].Vector(3);
  if (color.minCoeff() < 0 || color.maxCoeff() > 255) json["color_rgb"].Fail("values in 0..255");
  record.color = {ToChannel(color[0]), ToChannel(color[1]), ToChannel(color[2])};
  return record;
}

OrientedBox ToBox(const JsonField& json) {
  OrientedBox box;
  box.T_world_box = {json["rotation_xyzw"].UnitQuaternion(), json["center"].Vector(3)};
  box.half_size = 0.5 * json["size"].Vector(3);
  if (box.half_size.minCoeff() < 0) json["size"].Fail("sizes of at least 0");
  return box;
}

ObjectRecord ToObject(const JsonField& json, const std::set<std::uint32_t>& labels) {
  ObjectRecord record;
  record.id = static_cast<std::uint32_t>(json["id"].Unsigned(kMaxId));
  record.label = static_cast<std::uint32_t>(json["label"].Unsigned(kMaxId));
  if (!labels.contains(record.label)) json["label"].Fail("a label of the class table");
  record.confidence = json["confidence"].Number();
  record.entropy = json["entropy"].Number();
  record.num_views = json["num_views"].Unsigned(std::numeric_limits<std::uint64_t>::max());
  record.num_points = json["num_points"].Unsigned(std::numeric_limits<std::uint64_t>::max());
  record.centroid = json["centroid"].Vector(3);
  record.box = ToBox(json["box"]);
  const JsonField support = json["supported_by"];
  record.supporting_segment = static_cast<std::uint32_t>(support["segment"].Unsigned(kMaxId));
  record.supporting_object = static_cast<std::uint32_t>(support["object"].Unsigned(kMaxId));
  return record;
}

}  // namespace

ObjectsFile ReadObjects(const std::filesystem::path& path) {
  const JsonField root = JsonField::FromFile(path);
  if (root["format"].String() != "semslam objects 3") root["format"].Fail("semslam objects 3");
  ObjectsFile file;
  std::set<std::uint32_t> labels;
  for (const JsonField& item : root["classes"].Items()) {
    file.classes.push_back(ToClass(item));
    if (!labels.insert(file.classes.back().label).second) item["label"].Fail("a label of its own");
  }
  for (const JsonField& item : root["objects"].Items()) {
    file.objects.push_back(ToObject(item, labels));
  }
  return file;
}

}  // namespace semslam

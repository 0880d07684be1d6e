// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/objects_io.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "semslam/io/atomic_file.h"

namespace semslam {
namespace {

using Json = nlohmann::ordered_json;  // Keeps the order of the fields.

Json ToJson(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json ToJson(const OrientedBox& box) {
  Eigen::Quaterniond q = box.T_world_box.rotation;
  if (q.w() < 0) q.coeffs() *= -1.0;  // q and -q are the same rotation: write one of them.
  return {{"center", ToJson(box.T_world_box.translation)},
          {"rotation_xyzw", {q.x(), q.y(), q.z(), q.w()}},
          {"size", ToJson(2.0 * box.half_size)}};
}

Json ToJson(const ClassRecord& entry) {
  return {{"label", entry.label},
          {"name", entry.name},
          {"color_rgb", {entry.color.r, entry.color.g, entry.color.b}}};
}

Json ToJson(const ObjectRecord& object, const std::vector<ClassRecord>& classes) {
  const auto found = std::find_if(classes.begin(), classes.end(), [&](const ClassRecord& entry) {
    return entry.label == object.label;
  });
  return {{"id", object.id},
          {"label", object.label},
          {"class", found == classes.end() ? "" : found->name},
          {"confidence", object.confidence},
          {"entropy", object.entropy},
          {"num_views", object.num_views},
          {"num_points", object.num_points},
          {"centroid", ToJson(object.centroid)},
          {"box", ToJson(object.box)},
          {"supported_by",
           {{"segment", object.supporting_segment}, {"object", object.supporting_object}}}};
}

}  // namespace

void WriteObjects(const std::filesystem::path& path,
                  const std::vector<ClassRecord>& classes,
                  const std::vector<ObjectRecord>& objects) {
  Json json = {{"format", "semslam objects 3"},
               {"units",
                {{"length", "metre"},
                 {"confidence", "probability in [0, 1]"},
                 {"entropy", "0 sure, 1 all outcomes equally probable"}}},
               {"frame", "world = camera of the first keyframe: x right, y down, z forward"},
               {"classes", Json::array()},
               {"objects", Json::array()}};
  for (const ClassRecord& entry : classes) json["classes"].push_back(ToJson(entry));
  for (const ObjectRecord& object : objects) json["objects"].push_back(ToJson(object, classes));
  constexpr int kIndent = 2;
  // Class names come from users' files: bytes that are no UTF-8 are replaced.
  WriteFileAtomically(path, json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n');
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <set>
#include <utility>

#include "semslam/base/error.h"
#include "semslam/eval/map_evaluation.h"
#include "semslam/io/cloud_io.h"

namespace semslam {
namespace {

CloudColumns ReadLabelled(const std::filesystem::path& path) {
  CloudColumns cloud = ReadPcd(path);
  if (cloud.labels.size() != cloud.positions.size()) {
    throw InputError(path.string() + ": expected the field label");
  }
  return cloud;
}

void CheckLabels(const std::filesystem::path& path, const MapResult& result) {
  std::set<std::uint32_t> known = {0};
  for (const ClassRecord& entry : result.classes) known.insert(entry.label);
  for (const std::uint32_t label : result.labels) {
    if (known.contains(label)) continue;
    throw InputError(path.string() +
                     ": expected labels of the class table in objects.json, found " +
                     std::to_string(label));
  }
}

}  // namespace

MapResult ReadMapResult(const std::filesystem::path& folder) {
  MapResult result;
  result.trajectory = ReadTrajectory(folder / "CameraTrajectory.txt");
  CloudColumns segments = ReadLabelled(folder / "segmentation.pcd");
  CloudColumns labels = ReadLabelled(folder / "semantic_map.pcd");
  if (segments.positions != labels.positions) {
    throw InputError((folder / "semantic_map.pcd").string() +
                     ": expected the points of segmentation.pcd, " +
                     std::to_string(segments.positions.size()) + ", found others, " +
                     std::to_string(labels.positions.size()));
  }
  ObjectsFile objects = ReadObjects(folder / "objects.json");
  result.positions = std::move(segments.positions);
  result.segments = std::move(segments.labels);
  result.labels = std::move(labels.labels);
  result.classes = std::move(objects.classes);
  result.objects = std::move(objects.objects);
  CheckLabels(folder / "semantic_map.pcd", result);
  return result;
}

}  // namespace semslam

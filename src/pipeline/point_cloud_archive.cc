// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// What PointCloudMapping puts into a map file.
#include <cstdint>

#include "semslam/base/check.h"
#include "semslam/dense/keyframe_cloud_archive.h"
#include "semslam/pipeline/point_cloud_mapping.h"
#include "semslam/semantics/detection_archive.h"

namespace semslam {
namespace {

bool HaveSameNames(const ClassTable& a, const ClassTable& b) {
  if (a.size() != b.size()) return false;
  for (int id = 0; id < static_cast<int>(a.size()); ++id) {
    if (a.name(id) != b.name(id)) return false;
  }
  return true;
}

}  // namespace

void PointCloudMapping::Write(BinaryWriter* writer) const {
  writer->Write<std::uint64_t>(clouds_.size());
  for (const auto& [id, cloud] : clouds_) WriteKeyframeCloud(*cloud, writer);
  WriteClassTable(classes_, writer);
  writer->Write<std::uint64_t>(detections_.size());
  for (const auto& [id, detections] : detections_) {
    writer->Write(id.value);
    WriteDetections(detections, writer);
  }
}

bool PointCloudMapping::Restore(BinaryReader* reader) {
  SEMSLAM_CHECK(clouds_.empty() && detections_.empty()) << "something was inserted already";
  const std::size_t num_clouds = reader->ReadCount(sizeof(std::uint32_t));
  for (std::size_t i = 0; i < num_clouds; ++i) {
    std::shared_ptr<const KeyframeCloud> cloud = ReadKeyframeCloud(reader, rays_);
    const KeyframeId id = cloud->id();
    const Places places = look_up_({id});
    if (places.T_world_camera.empty() && places.apart.empty())
      reader->Fail("a cloud belongs to a keyframe that is not there");
    if (!clouds_.emplace(id, cloud).second) reader->Fail("a keyframe has two clouds");
    sight_.Write([&](Sight& sight) { sight.clouds[id] = cloud; });
    if (!places.apart.contains(id))
      voxel_map_.Integrate(std::move(cloud), places.T_world_camera.at(id));
  }
  const ClassTable classes = ReadClassTable(reader);
  std::map<KeyframeId, std::vector<Detection>> detections;
  const std::size_t num_labelled = reader->ReadCount(sizeof(std::uint32_t));
  for (std::size_t i = 0; i < num_labelled; ++i) {
    const KeyframeId id{reader->Read<std::uint32_t>()};
    detections[id] = ReadDetections(reader, classes.size());
  }
  num_voxels_.Write([&](std::size_t& n) { n = voxel_map_.num_voxels(); });
  if (classes_.size() == 0) classes_ = classes;
  if (!HaveSameNames(classes_, classes)) return detections.empty();
  detections_ = std::move(detections);
  return true;
}

}  // namespace semslam

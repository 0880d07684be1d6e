// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "result_files.h"

#include <cstdint>
#include <functional>

#include "semslam/base/error.h"
#include "semslam/io/map_files.h"
#include "semslam/io/trajectory_io.h"

namespace {

using semslam::kNoClass;
using semslam::PointCloudMapping;
using semslam::SemanticMap;

// In files 0 means no class.
std::uint32_t FileLabel(int class_id) {
  return class_id == kNoClass ? 0 : static_cast<std::uint32_t>(class_id) + 1;
}

std::vector<semslam::ClassRecord> ClassesOfInterest(const semslam::ClassTable& classes) {
  std::vector<semslam::ClassRecord> records;
  for (int id = 0; id < static_cast<int>(classes.size()); ++id) {
    if (classes.is_of_interest(id)) {
      records.push_back({FileLabel(id), classes.name(id), classes.color(id)});
    }
  }
  return records;
}

std::vector<semslam::ObjectRecord> ToRecords(const std::vector<semslam::SemanticObject>& objects) {
  std::vector<semslam::ObjectRecord> records;
  for (const semslam::SemanticObject& object : objects) {
    semslam::ObjectRecord record;
    record.id = object.id;
    record.label = FileLabel(object.class_id);
    record.confidence = object.confidence;
    record.num_views = object.num_views;
    record.num_points = object.num_points;
    record.centroid = object.centroid;
    record.box = object.box;
    records.push_back(record);
  }
  return records;
}

void WriteMap(const std::filesystem::path& folder, const PointCloudMapping::Result& map) {
  std::vector<std::uint32_t> labels;
  labels.reserve(map.semantics.class_of_point.size());
  for (const int class_id : map.semantics.class_of_point) labels.push_back(FileLabel(class_id));
  semslam::LabelledMapView view;
  view.cloud = {.positions = map.cloud.positions,
                .colors = map.cloud.colors,
                .normals = map.cloud.normals,
                .labels = labels,
                .segments = map.semantics.segment_of_point,
                .objects = map.semantics.object_of_point,
                .confidences = map.semantics.confidence_of_point};
  view.point_size = map.cloud.voxel_size;
  view.classes = ClassesOfInterest(map.semantics.classes);
  view.objects = ToRecords(map.semantics.objects);
  semslam::WriteMapFiles(folder, view);
}

semslam::Trajectory ToTrajectory(const std::vector<semslam::System::TrackedPose>& poses) {
  semslam::Trajectory trajectory;
  for (const auto& pose : poses) trajectory.push_back({pose.time, pose.T_world_camera});
  return trajectory;
}

}  // namespace

std::string WriteResults(const std::filesystem::path& folder,
                         const semslam::System& system,
                         const PointCloudMapping::Result& map) {
  const std::function<void()> writers[] = {
      [&] {
        semslam::WriteTrajectory(folder / "CameraTrajectory.txt",
                                 ToTrajectory(system.CameraTrajectory()));
      },
      [&] {
        semslam::WriteTrajectory(folder / "KeyFrameTrajectory.txt",
                                 ToTrajectory(system.KeyframeTrajectory()));
      },
      [&] { WriteMap(folder, map); },
  };
  std::string first_error;
  for (const auto& write : writers) {
    try {
      write();
    } catch (const semslam::InputError& error) {
      if (first_error.empty()) first_error = error.what();
    }
  }
  return first_error;
}

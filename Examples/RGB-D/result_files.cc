// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "result_files.h"

#include <cstdint>
#include <functional>

#include "semslam/base/error.h"
#include "semslam/io/cloud_io.h"
#include "semslam/io/map_picture.h"
#include "semslam/io/objects_io.h"
#include "semslam/io/trajectory_io.h"

namespace {

using semslam::kNoClass;
using semslam::PointCloudMapping;

// In files 0 means no class.
std::uint32_t FileLabel(int class_id) {
  return class_id == kNoClass ? 0 : static_cast<std::uint32_t>(class_id) + 1;
}

// The columns of the semantic map's files.
struct SemanticColumns {
  std::vector<semslam::Rgb> colors;
  std::vector<std::uint32_t> labels;
};

SemanticColumns MakeColumns(const semslam::SemanticMap& map) {
  SemanticColumns columns;
  columns.colors.reserve(map.class_of_point.size());
  columns.labels.reserve(map.class_of_point.size());
  for (const int class_id : map.class_of_point) {
    columns.colors.push_back(class_id == kNoClass ? semslam::kNoClassColor
                                                  : map.classes.color(class_id));
    columns.labels.push_back(FileLabel(class_id));
  }
  return columns;
}

// The classes of interest, and any other that an object has.
std::vector<semslam::ClassRecord> MakeClasses(const semslam::SemanticMap& map) {
  std::vector<semslam::ClassRecord> classes;
  for (int id = 0; id < static_cast<int>(map.classes.size()); ++id) {
    if (map.classes.is_of_interest(id)) {
      classes.push_back({FileLabel(id), map.classes.name(id), map.classes.color(id)});
    }
  }
  return classes;
}

std::vector<semslam::ObjectRecord> MakeObjects(const semslam::SemanticMap& map) {
  std::vector<semslam::ObjectRecord> records;
  for (const semslam::SemanticObject& object : map.objects) {
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

semslam::Trajectory ToTrajectory(const std::vector<semslam::System::TrackedPose>& poses) {
  semslam::Trajectory trajectory;
  for (const auto& pose : poses) trajectory.push_back({pose.time, pose.T_world_camera});
  return trajectory;
}

}  // namespace

std::vector<std::string> WriteResults(const std::filesystem::path& folder,
                                      const semslam::System& system,
                                      const PointCloudMapping::Result& map) {
  const SemanticColumns columns = MakeColumns(map.semantics);
  const std::vector<semslam::ClassRecord> classes = MakeClasses(map.semantics);
  const std::vector<semslam::ObjectRecord> objects = MakeObjects(map.semantics);
  const std::vector<semslam::SegmentId>& segments = map.semantics.segment_of_point;
  const auto& positions = map.cloud.positions;
  const semslam::CloudView semantic_cloud{.positions = positions,
                                          .colors = columns.colors,
                                          .labels = columns.labels,
                                          .segments = segments,
                                          .objects = map.semantics.object_of_point,
                                          .confidences = map.semantics.confidence_of_point};
  const std::function<void()> writers[] = {
      [&] {
        WriteTrajectory(folder / "CameraTrajectory.txt", ToTrajectory(system.CameraTrajectory()));
      },
      [&] {
        WriteTrajectory(folder / "KeyFrameTrajectory.txt",
                        ToTrajectory(system.KeyframeTrajectory()));
      },
      [&] {
        WritePcd(folder / "global_color.pcd", {.positions = positions, .colors = map.cloud.colors});
      },
      [&] { WritePcd(folder / "segmentation.pcd", {.positions = positions, .labels = segments}); },
      [&] {
        WritePcd(folder / "semantic_map.pcd",
                 {.positions = positions, .colors = columns.colors, .labels = columns.labels});
      },
      [&] { WritePly(folder / "semantic_map.ply", semantic_cloud); },
      [&] { WriteObjects(folder / "objects.json", classes, objects); },
      [&] {
        semslam::MapPictureInput input;
        input.cloud = {.positions = positions,
                       .colors = map.cloud.colors,
                       .normals = map.cloud.normals,
                       .labels = columns.labels,
                       .segments = segments};
        input.point_size = map.cloud.voxel_size;
        input.classes = classes;
        input.objects = objects;
        WriteMapPictures(folder, input);
      },
  };
  std::vector<std::string> errors;
  for (const auto& write : writers) {
    try {
      write();
    } catch (const semslam::InputError& error) {
      errors.emplace_back(error.what());
    }
  }
  return errors;
}

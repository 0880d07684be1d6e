// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "map_view.h"

namespace {

using semslam::LabelOfClass;

std::vector<semslam::ClassRecord> ClassesOfInterest(const semslam::ClassTable& classes) {
  std::vector<semslam::ClassRecord> records;
  for (int id = 0; id < static_cast<int>(classes.size()); ++id) {
    if (classes.is_of_interest(id)) {
      records.push_back({LabelOfClass(id), classes.name(id), classes.color(id)});
    }
  }
  return records;
}

std::vector<semslam::ObjectRecord> ToRecords(const std::vector<semslam::SemanticObject>& objects) {
  std::vector<semslam::ObjectRecord> records;
  for (const semslam::SemanticObject& object : objects) {
    semslam::ObjectRecord record;
    record.id = object.id;
    record.label = LabelOfClass(object.class_id);
    record.confidence = object.confidence;
    record.entropy = object.entropy;
    record.num_views = object.num_views;
    record.supporting_segment = object.supporting_segment;
    record.supporting_object = object.supporting_object;
    record.num_points = object.num_points;
    record.centroid = object.centroid;
    record.box = object.box;
    records.push_back(record);
  }
  return records;
}

}  // namespace

MapView::MapView(const semslam::PointCloudMapping::Result& map) {
  labels_.reserve(map.semantics.class_of_point.size());
  for (const int class_id : map.semantics.class_of_point) labels_.push_back(LabelOfClass(class_id));
  view_.cloud = {.positions = map.cloud.positions,
                 .colors = map.cloud.colors,
                 .normals = map.cloud.normals,
                 .labels = labels_,
                 .segments = map.semantics.segment_of_point,
                 .objects = map.semantics.object_of_point,
                 .confidences = map.semantics.confidence_of_point,
                 .entropies = map.semantics.entropy_of_point};
  view_.segments_by_geometry = map.segmentation.segment_of_point;
  view_.point_size = map.cloud.voxel_size;
  view_.classes = ClassesOfInterest(map.semantics.classes);
  view_.objects = ToRecords(map.semantics.objects);
}

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "semslam/dense/rgb.h"
#include "semslam/geometry/oriented_box.h"
#include "semslam/semantics/class_table.h"

namespace semslam {

// A class as files and pictures show it. `label` is the number that stands in the label column of
// the semantic map's files; 0 is kept for "no class".
struct ClassRecord {
  std::uint32_t label = 0;
  std::string name;
  Rgb color;
};

// The label of a class id of a ClassTable; 0 for kNoClass.
inline std::uint32_t LabelOfClass(int class_id) {
  return static_cast<std::uint32_t>(class_id - kNoClass);
}

struct ObjectRecord {
  std::uint32_t id = 0;     // From 1, as in the object column of the semantic map's files.
  std::uint32_t label = 0;  // Of its class.
  double confidence = 0;    // Of its class, in [0, 1].
  double entropy = 0;       // Of its distribution over classes: 0 sure, 1 nothing is known.
  std::uint64_t num_views = 0;
  std::uint64_t num_points = 0;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  // World, metres.
  OrientedBox box;                                     // World.
  // What it stands on: a segment as in the files' segment column, and the object that is part of.
  // 0: not known, none.
  std::uint32_t supporting_segment = 0;
  std::uint32_t supporting_object = 0;
};

// Writes objects.json: units, frame, class table, and the objects in the given order, each with id,
// class (label and name), confidence, entropy, num_views, num_points, centroid, oriented box
// (centre, rotation as quaternion x y z w, size along the box's axes), and what it stands on.
// docs/objects.schema.json describes it. Throws InputError.
void WriteObjects(const std::filesystem::path& path,
                  const std::vector<ClassRecord>& classes,
                  const std::vector<ObjectRecord>& objects);

struct ObjectsFile {
  std::vector<ClassRecord> classes;
  std::vector<ObjectRecord> objects;
};

// Reads what WriteObjects wrote. Throws InputError that names file and field.
ObjectsFile ReadObjects(const std::filesystem::path& path);

}  // namespace semslam

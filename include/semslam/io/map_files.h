// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "semslam/io/cloud_io.h"
#include "semslam/io/objects_io.h"

namespace semslam {

// A map as it is written and shown; the clouds stay where they are.
struct LabelledMapView {
  // Positions and colours; the rest as far as known. Ids and labels are 0 where there is none.
  CloudView cloud;
  // The segments before boxes parted any, for segmentation.pcd. Empty: the cloud's.
  std::span<const std::uint32_t> segments_by_geometry = {};
  double point_size = 0.01;  // Metres: the distance of neighbouring points (the voxel size).
  std::vector<ClassRecord> classes;
  std::vector<ObjectRecord> objects;
  // Upwards in the world, if it is known; the length does not matter. Otherwise the normal that
  // most of the surface has among those within 60 degrees of -y (the up of the first camera), for
  // desks and floors are flat; without normals -y.
  std::optional<Eigen::Vector3d> up;
};

// The colours of the semantic map: of its class for a labelled point, and a muted grey of its own
// brightness for every other.
std::vector<Rgb> SemanticColors(const LabelledMapView& map);

// Writes into the folder
//   global_color.pcd    XYZRGBA
//   segmentation.pcd    XYZL, the label is the segment, by geometry alone
//   semantic_map.pcd    XYZRGBL, colour and label of the class
//   semantic_map.ply    the same with normal, segment, object, confidence and entropy
//   objects.json
//   semantic_map_top.png, semantic_map_view.png
// each complete or not at all. Throws InputError.
void WriteMapFiles(const std::filesystem::path& folder, const LabelledMapView& map);

}  // namespace semslam

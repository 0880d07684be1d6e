// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "semslam/io/cloud_io.h"
#include "semslam/io/objects_io.h"

namespace semslam {

// What the pictures of a map show.
struct MapPictureInput {
  // Positions and colours; segments (0: none) and labels (0: none) may be empty. With normals the
  // surfaces are shaded and the upright direction is found from them.
  CloudView cloud;
  double point_size = 0.01;  // Metres: the distance of neighbouring points (the voxel size).
  std::vector<ClassRecord> classes;
  std::vector<ObjectRecord> objects;
  // Upwards in the world, if it is known; the length does not matter. Otherwise the normal that
  // most of the surface has among those within 60 degrees of -y (the up of the first camera), for
  // desks and floors are flat; without normals -y.
  std::optional<Eigen::Vector3d> up;
};

struct MapPictureOptions {
  int panel_width = 720;   // Pixels, of each of the three panels.
  int panel_height = 540;  // Pixels, without title and legend.
  int supersampling = 2;   // Rendered so many times larger, then averaged.
  void Validate() const;   // Throws std::invalid_argument.
};

enum class MapPictureView {
  kTop,          // From straight above, the first camera's view direction upwards.
  kPerspective,  // From behind and above the first camera.
};

// Draws colour, segments and classes side by side, with titles, a legend, and the objects' boxes
// and names: CV_8UC3, BGR. In software: neither window system nor graphics card is needed. The same
// input gives the same pixels.
cv::Mat DrawMapPicture(const MapPictureInput& input,
                       MapPictureView view,
                       const MapPictureOptions& options = {});

// Writes semantic_map_top.png and semantic_map_view.png. Throws InputError.
void WriteMapPictures(const std::filesystem::path& folder,
                      const MapPictureInput& input,
                      const MapPictureOptions& options = {});

}  // namespace semslam

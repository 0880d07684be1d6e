// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "semslam/dense/rgb.h"

namespace semslam {

// The dense map as a point cloud in world coordinates, one point a voxel, in the order of the voxel
// keys. All vectors have the same length.
struct MapCloud {
  double voxel_size = 0;                   // Metres.
  std::vector<Eigen::Vector3f> positions;  // Metres.
  std::vector<Eigen::Vector3f> normals;    // Unit length, towards the cameras that saw the point.
  std::vector<Rgb> colors;
  std::vector<float> weights;            // Sum of the observations' weights.
  std::vector<std::uint32_t> num_views;  // Keyframes that saw the point.

  std::size_t size() const { return positions.size(); }
};

}  // namespace semslam

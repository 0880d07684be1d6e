// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "semslam/base/time.h"
#include "semslam/camera/virtual_stereo.h"
#include "semslam/features/descriptor.h"
#include "semslam/features/feature_grid.h"

namespace semslam {

// A corner of an RGB-D image.
struct Keypoint {
  Eigen::Vector2f pixel{0, 0};      // Ideal (undistorted) pixel of the full image.
  Eigen::Vector2f raw_pixel{0, 0};  // As recorded.
  float depth = 0;                  // Metres along the optical axis; 0 = none.
  float right_x = kNoRightX;        // pixel.x - bf / depth: column in a virtual right camera.
  float angle = 0;                  // Radians in [0, 2 pi), from the x axis to the y axis.
  std::int16_t octave = 0;          // Pyramid level it was found on; 0 = the full image.
  float response = 0;               // Strength of the corner.

  bool has_depth() const { return depth > 0; }
};

// What is kept of an image: keypoints[i] and descriptors[i] belong to the same feature.
struct Frame {
  TimeNs time = 0;
  std::vector<Keypoint> keypoints;
  std::vector<Descriptor> descriptors;
  FeatureGrid grid;
};

}  // namespace semslam

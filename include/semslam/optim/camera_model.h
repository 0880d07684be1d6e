// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "semslam/camera/pinhole_camera.h"
#include "semslam/camera/virtual_stereo.h"

namespace semslam {

// An ideal (undistorted) pinhole camera with a virtual second camera to its right, which turns a
// depth into a third pixel coordinate whose error is like that of the other two (Mur-Artal and
// Tardos 2017). A point (x, y, z) of the camera frame is seen at
//   u = fx x / z + cx,  v = fy y / z + cy,  right_x = u - bf / z.
struct StereoCamera {
  double fx = 0;  // Pixels.
  double fy = 0;
  double cx = 0;
  double cy = 0;
  double bf = 0;  // Virtual baseline (m) times fx (px).
};

inline StereoCamera MakeStereoCamera(const PinholeCamera& camera, double baseline_times_fx) {
  return {camera.fx(), camera.fy(), camera.cx(), camera.cy(), baseline_times_fx};
}

// Where a camera saw a point: two measured numbers, or three with depth.
struct ImagePoint {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // Undistorted.
  double right_x = kNoRightX;                       // u in the virtual right camera, pixels.
  double inverse_variance = 1;  // 1 / px^2, the same for all two or three numbers; > 0.

  bool has_right() const { return right_x != kNoRightX; }
};

// Squared errors over their variance above these are outliers: the 95 % points of the chi-squared
// distribution. Their roots are the widths of the Huber kernels.
struct Chi2Limits {
  double without_depth = 5.991;  // Two degrees of freedom.
  double with_depth = 7.815;     // Three.

  double Of(const ImagePoint& image) const {
    return image.has_right() ? with_depth : without_depth;
  }
};

}  // namespace semslam

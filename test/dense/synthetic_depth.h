// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "semslam/camera/pinhole_camera.h"
#include "semslam/camera/rgbd_image.h"
#include "semslam/geometry/rigid3.h"

namespace semslam::testing {

inline PinholeCamera TestCamera() {
  return PinholeCamera(
      {.width = 320, .height = 240, .fx = 260, .fy = 260, .cx = 159.5, .cy = 119.5});
}

// Exact depth of an axis-aligned room of boxes: {min corner, max corner} in world coordinates. A
// plane is a thin box.
struct Box {
  Eigen::Vector3d low;
  Eigen::Vector3d high;
  int blue = 128;  // Blue channel of its colour, to tell boxes apart.
};

// Distance along the ray to a box, by slabs; infinity where it is missed.
inline double HitBox(const Box& box, const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) {
  double entry = 0;
  double exit = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.low[axis] - origin[axis]) / ray[axis];
    const double b = (box.high[axis] - origin[axis]) / ray[axis];
    entry = std::max(entry, std::min(a, b));
    exit = std::min(exit, std::max(a, b));
  }
  return entry <= exit && entry > 0 ? entry : std::numeric_limits<double>::infinity();
}

inline RgbdImage RenderBoxes(const std::vector<Box>& boxes,
                             const PinholeCamera& camera,
                             const Rigid3& T_world_camera) {
  RgbdImage image;
  image.color = cv::Mat(camera.height(), camera.width(), CV_8UC3, cv::Scalar(0, 0, 0));
  image.depth = cv::Mat::zeros(camera.height(), camera.width(), CV_32FC1);
  for (int row = 0; row < camera.height(); ++row) {
    for (int column = 0; column < camera.width(); ++column) {
      const Eigen::Vector2d pixel(column, row);
      const Eigen::Vector3d ray =
          T_world_camera.rotation * camera.Unproject(camera.Undistort(pixel), 1.0);
      double nearest = std::numeric_limits<double>::infinity();
      for (const Box& box : boxes) {
        const double z = HitBox(box, T_world_camera.translation, ray);
        if (z >= nearest) continue;
        nearest = z;
        image.color.at<cv::Vec3b>(row, column) =
            cv::Vec3b(static_cast<std::uint8_t>(box.blue), 90, 200);
      }
      if (std::isfinite(nearest)) {
        image.depth.at<float>(row, column) = static_cast<float>(nearest);
      }
    }
  }
  return image;
}

// Depth as a structured-light camera gives it: disparity in eighths of a pixel.
inline void QuantiseDepth(cv::Mat& depth, double step_at_1m) {
  for (int row = 0; row < depth.rows; ++row) {
    for (int column = 0; column < depth.cols; ++column) {
      auto& z = depth.at<float>(row, column);
      if (z > 0) z = static_cast<float>(1.0 / (std::round(1.0 / z / step_at_1m) * step_at_1m));
    }
  }
}

}  // namespace semslam::testing

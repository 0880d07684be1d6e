// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace semslam {

// A virtual camera: x right, y down, z forward; pixel (0, 0) is the centre of the top-left pixel.
struct ViewCamera {
  Eigen::Matrix3f R_camera_world = Eigen::Matrix3f::Identity();
  Eigen::Vector3f p_world = Eigen::Vector3f::Zero();  // Where it stands.
  float focal_length = 0;                             // Pixels.
  int width = 0;
  int height = 0;

  Eigen::Vector3f ToCamera(const Eigen::Vector3f& point) const {
    return R_camera_world * (point - p_world);
  }
  // Of a point in front of the camera, in the camera's frame.
  Eigen::Vector2f Project(const Eigen::Vector3f& p_camera) const {
    return {focal_length * p_camera.x() / p_camera.z() + 0.5F * static_cast<float>(width - 1),
            focal_length * p_camera.y() / p_camera.z() + 0.5F * static_cast<float>(height - 1)};
  }
};

// A camera that looks along `forward` and stands where almost all points just fit into the picture;
// the few that are far from the rest may be cut off. Not for an empty cloud.
ViewCamera FitCamera(std::span<const Eigen::Vector3f> positions,
                     const Eigen::Vector3f& forward,
                     const Eigen::Vector3f& up,
                     float field_of_view,
                     int width,
                     int height);

}  // namespace semslam

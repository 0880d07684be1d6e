// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include <Eigen/Core>

#include "semslam/io/level_frame.h"
#include "semslam/io/view_camera.h"

namespace semslam {

// A virtual camera that looks at a place from some distance and is turned, moved and brought nearer
// by a mouse. It stays upright. A value.
class OrbitCamera {
 public:
  explicit OrbitCamera(const LevelFrame& frame = {}) : frame_(frame) {}

  // Where the place is seen from. Azimuth 0 looks forward, positive ones look from the left to the
  // right; elevation is the angle by which it looks down, -pi/2 to pi/2 (from straight above, and
  // then forward is upwards in the picture). Radians.
  void SetDirection(double azimuth, double elevation);
  // Stands where almost all of these points just fit into a picture of this shape. Nothing changes
  // without points.
  void Fit(std::span<const Eigen::Vector3f> points, int width, int height);
  void LookAt(const Eigen::Vector3d& target, double distance);
  void SetTarget(const Eigen::Vector3d& target) { target_ = target; }
  // Vertical, radians.
  void SetFieldOfView(double field_of_view);

  void Turn(double azimuth, double elevation);
  // Moves the place by so many pixels of a picture of this height: what is under the mouse stays
  // there.
  void Pan(double dx, double dy, int height);
  // The distance is multiplied by this factor.
  void Zoom(double factor);

  ViewCamera At(int width, int height) const;

  const LevelFrame& frame() const { return frame_; }
  const Eigen::Vector3d& target() const { return target_; }
  double distance() const { return distance_; }
  double azimuth() const { return azimuth_; }
  double elevation() const { return elevation_; }

 private:
  Eigen::Matrix3d R_camera_world() const;
  double FocalLength(int height) const;

  LevelFrame frame_;
  Eigen::Vector3d target_ = Eigen::Vector3d::Zero();
  double distance_ = 3;  // Metres.
  double azimuth_ = 0;
  double elevation_ = 0.6;
  double field_of_view_ = 0.75;
};

// From the world to OpenGL's clip coordinates, for what is between the two depths (metres).
Eigen::Matrix4f ClipFromWorld(const ViewCamera& camera, float near, float far);

// The direction in the world in which a pixel looks; of unit length.
Eigen::Vector3d PixelRay(const ViewCamera& camera, const Eigen::Vector2d& pixel);

}  // namespace semslam

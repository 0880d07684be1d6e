// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/level_frame.h"

#include "semslam/dense/up_direction.h"

namespace semslam {

LevelFrame LevelFrameWithUp(const Eigen::Vector3d& up) {
  LevelFrame frame;
  frame.up = up;
  const auto flatten = [&](const Eigen::Vector3d& v) { return v - v.dot(frame.up) * frame.up; };
  frame.forward = flatten(Eigen::Vector3d::UnitZ());
  // The first camera looked straight up or down.
  if (frame.forward.norm() < 0.1) frame.forward = flatten(-Eigen::Vector3d::UnitY());
  frame.forward.normalize();
  frame.right = frame.forward.cross(frame.up);
  return frame;
}

LevelFrame FindLevelFrame(const LabelledMapView& map) {
  if (map.up) return LevelFrameWithUp(map.up->normalized());
  const Eigen::Vector3f camera_up = -Eigen::Vector3f::UnitY();
  return LevelFrameWithUp(
      CommonUpNormal(map.cloud.normals, camera_up).value_or(camera_up).cast<double>());
}

}  // namespace semslam

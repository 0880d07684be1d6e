// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>

#include <semslam/base/time.h>
#include <semslam/camera/pinhole_camera.h>
#include <semslam/geometry/rigid3.h>

int main() {
  const semslam::PinholeCamera camera({.fx = 525, .fy = 525, .cx = 319.5, .cy = 239.5});
  const semslam::Rigid3 T_world_camera{semslam::ExpSO3({0, 0, 0}), {0, 0, 1}};
  const Eigen::Vector3d p_world = T_world_camera * camera.Unproject({319.5, 239.5}, 2.0);
  std::cout << semslam::FormatTime(semslam::FromSeconds(p_world.z()), 3) << '\n';
}

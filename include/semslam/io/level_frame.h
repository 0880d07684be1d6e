// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "semslam/io/map_files.h"

namespace semslam {

// Level axes of the world: the ground plane, and forward as the first camera looked. Unit length.
struct LevelFrame {
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  Eigen::Vector3d forward = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();
};

// With up as the map says it, or as LabelledMapView::up tells.
LevelFrame FindLevelFrame(const LabelledMapView& map);
// The level frame with this upwards (of unit length).
LevelFrame LevelFrameWithUp(const Eigen::Vector3d& up);

}  // namespace semslam

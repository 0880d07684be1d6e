// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "semslam/base/id.h"
#include "semslam/features/frame.h"
#include "semslam/geometry/rigid3.h"

namespace semslam {

// What a feature of a tracked frame shows.
struct TrackedPoint {
  std::optional<LandmarkId> landmark;  // Nothing: a temporary point from the last frame's depth.
  Eigen::Vector3d p_world = Eigen::Vector3d::Zero();
};

// A frame with its pose and, a feature, the point it shows.
struct TrackedFrame {
  std::shared_ptr<const Frame> frame;
  Rigid3 T_world_camera;
  std::vector<std::optional<TrackedPoint>> points;  // One a feature.

  int NumLandmarks() const {
    int count = 0;
    for (const std::optional<TrackedPoint>& point : points) {
      if (point && point->landmark) ++count;
    }
    return count;
  }
};

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "semslam/camera/pinhole_camera.h"
#include "semslam/tracking/tracked_frame.h"

namespace semslam {

struct NewPointOptions {
  double close_depth_m = 0;  // All points closer than this,
  int min_count = 0;         // or so many of the closest, counting those that show a point already.
};

// The features with depth that show nothing yet and are worth a point, closest first.
std::vector<int> FeaturesForNewPoints(const TrackedFrame& frame, const NewPointOptions& options);

// World position of a feature with depth.
Eigen::Vector3d BackProject(const PinholeCamera& camera, const TrackedFrame& frame, int feature);

}  // namespace semslam

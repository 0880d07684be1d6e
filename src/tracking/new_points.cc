// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tracking/new_points.h"

#include <algorithm>
#include <utility>

namespace semslam {

std::vector<int> FeaturesForNewPoints(const TrackedFrame& frame, const NewPointOptions& options) {
  std::vector<std::pair<float, int>> by_depth;
  for (std::size_t i = 0; i < frame.points.size(); ++i) {
    const float depth = frame.frame->keypoints[i].depth;
    if (depth > 0) by_depth.emplace_back(depth, static_cast<int>(i));
  }
  std::sort(by_depth.begin(), by_depth.end());
  std::vector<int> features;
  int num_seen = 0;
  for (const auto& [depth, feature] : by_depth) {
    if (depth > options.close_depth_m && num_seen >= options.min_count) break;
    ++num_seen;
    if (!frame.points[feature]) features.push_back(feature);
  }
  return features;
}

Eigen::Vector3d BackProject(const PinholeCamera& camera, const TrackedFrame& frame, int feature) {
  const Keypoint& keypoint = frame.frame->keypoints[feature];
  return frame.T_world_camera * camera.Unproject(keypoint.pixel.cast<double>(), keypoint.depth);
}

}  // namespace semslam

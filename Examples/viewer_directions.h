// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include <Eigen/Core>

// For every point of a cloud a vector towards its viewer: its normal, or where the cloud has none,
// the way to the origin, where the camera of a single view and the first camera of a map are.
inline std::vector<Eigen::Vector3f> ViewerDirections(const std::vector<Eigen::Vector3f>& points,
                                                     const std::vector<Eigen::Vector3f>& normals) {
  if (!normals.empty()) return normals;
  std::vector<Eigen::Vector3f> views;
  views.reserve(points.size());
  for (const Eigen::Vector3f& point : points) views.push_back(-point);
  return views;
}

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/view_camera.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "semslam/base/check.h"

namespace semslam {
namespace {

// Share of the points that may lie outside of each edge of the picture.
constexpr double kOutsideShare = 0.025;

// The value that only so small a share of the values exceeds.
float UpperQuantile(std::vector<float>& values, double share) {
  const std::size_t last = values.size() - 1;
  const auto rank =
      static_cast<std::ptrdiff_t>(std::lround((1.0 - share) * static_cast<double>(last)));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

// Along one axis of the picture: where the camera must stand so that the points fit between two
// lines of slope +-slope through it. A point (x, z) is inside if |x - camera_x| <= slope * (z -
// camera_z): two lower bounds, of which both are met with equality by the answer.
struct AxisFit {
  float position = 0;
  float depth = 0;
};

AxisFit FitAxis(const std::vector<Eigen::Vector3f>& points, int axis, float slope) {
  std::vector<float> right;
  std::vector<float> left;
  for (const Eigen::Vector3f& p : points) {
    right.push_back(p[axis] - slope * p.z());
    left.push_back(-p[axis] - slope * p.z());
  }
  const float right_bound = UpperQuantile(right, kOutsideShare);
  const float left_bound = UpperQuantile(left, kOutsideShare);
  return {0.5F * (right_bound - left_bound), -0.5F * (right_bound + left_bound) / slope};
}

}  // namespace

ViewCamera FitCamera(std::span<const Eigen::Vector3f> positions,
                     const Eigen::Vector3f& forward,
                     const Eigen::Vector3f& up,
                     float field_of_view,
                     int width,
                     int height) {
  ViewCamera camera;
  camera.width = width;
  camera.height = height;
  camera.focal_length = 0.5F * static_cast<float>(width) / std::tan(0.5F * field_of_view);
  const Eigen::Vector3f z = forward.normalized();
  const Eigen::Vector3f x = z.cross(up).normalized();
  camera.R_camera_world << x.transpose(), z.cross(x).transpose(), z.transpose();

  std::vector<Eigen::Vector3f> rotated;
  for (const Eigen::Vector3f& p : positions) {
    if (p.allFinite()) rotated.push_back(camera.R_camera_world * p);
  }
  SEMSLAM_CHECK(!rotated.empty()) << "no points";
  constexpr float kUsed = 0.92F;  // Of the picture; the rest is margin.
  const AxisFit fit_x =
      FitAxis(rotated, 0, kUsed * 0.5F * static_cast<float>(width) / camera.focal_length);
  const AxisFit fit_y =
      FitAxis(rotated, 1, kUsed * 0.5F * static_cast<float>(height) / camera.focal_length);
  constexpr float kMinDistance = 0.2F;  // Metres, for a cloud of one point.
  const float depth = std::min(fit_x.depth, fit_y.depth) - kMinDistance;
  camera.p_world =
      camera.R_camera_world.transpose() * Eigen::Vector3f(fit_x.position, fit_y.position, depth);
  return camera;
}

}  // namespace semslam

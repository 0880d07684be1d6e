// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tracking/pose_from_pixels.h"

#include <algorithm>

#include <opencv2/calib3d.hpp>

#include "semslam/base/check.h"

namespace semslam {
namespace {

Rigid3 FromOpenCv(const cv::Vec3d& rotation, const cv::Vec3d& translation) {
  const Rigid3 T_camera_world = {ExpSO3({rotation[0], rotation[1], rotation[2]}),
                                 {translation[0], translation[1], translation[2]}};
  return T_camera_world.Inverse();
}

}  // namespace

std::optional<PixelConsensus> FindPoseFromPixels(const PinholeCamera& camera,
                                                 std::span<const Eigen::Vector3d> p_world,
                                                 std::span<const Eigen::Vector2d> pixels,
                                                 double max_error_px,
                                                 const RansacOptions& options) {
  options.Validate();
  SEMSLAM_CHECK(p_world.size() == pixels.size()) << p_world.size() << ", " << pixels.size();
  constexpr std::size_t kFewest = 4;  // Three for the pose, one to choose among its solutions.
  if (p_world.size() < std::max(kFewest, static_cast<std::size_t>(options.min_inliers)))
    return std::nullopt;
  std::vector<cv::Point3d> objects;
  std::vector<cv::Point2d> images;
  for (const Eigen::Vector3d& p : p_world) objects.emplace_back(p.x(), p.y(), p.z());
  for (const Eigen::Vector2d& p : pixels) images.emplace_back(p.x(), p.y());
  const cv::Matx33d intrinsics(camera.fx(), 0, camera.cx(), 0, camera.fy(), camera.cy(), 0, 0, 1);
  cv::Vec3d rotation;
  cv::Vec3d translation;
  std::vector<int> inliers;
  // OpenCV draws the same samples each time.
  const bool found =
      cv::solvePnPRansac(objects, images, intrinsics, cv::noArray(), rotation, translation, false,
                         options.max_iterations, static_cast<float>(max_error_px),
                         options.confidence, inliers, cv::SOLVEPNP_P3P);
  if (!found || inliers.size() < static_cast<std::size_t>(options.min_inliers)) return std::nullopt;
  PixelConsensus consensus{FromOpenCv(rotation, translation),
                           std::vector<std::uint8_t>(p_world.size(), 0)};
  for (const int i : inliers) consensus.is_inlier[i] = 1;
  return consensus;
}

}  // namespace semslam

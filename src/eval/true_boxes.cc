// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/eval/true_boxes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <opencv2/imgproc.hpp>

#include "semslam/base/check.h"

namespace semslam {
namespace {

// Pixels of the outline of the instance's oriented box, in and out of the picture; 0 if a part of
// it is not before the camera.
double OutlineArea(const OrientedBox& box,
                   const Rigid3& T_camera_world,
                   const PinholeCamera& camera) {
  constexpr double kNearest = 0.05;  // Metres.
  std::vector<cv::Point2f> corners;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d signs((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1,
                                (corner & 4) != 0 ? 1 : -1);
    const Eigen::Vector3d p_camera =
        T_camera_world * (box.T_world_box * box.half_size.cwiseProduct(signs));
    if (p_camera.z() < kNearest) return 0;
    const Eigen::Vector2d pixel = camera.Project(p_camera);
    corners.emplace_back(static_cast<float>(pixel.x()), static_cast<float>(pixel.y()));
  }
  std::vector<cv::Point2f> outline;
  cv::convexHull(corners, outline);
  return cv::contourArea(outline);
}

// What is left of the mask without parts that are thinner than this at the instance's distance.
cv::Mat WithoutThinParts(const cv::Mat& mask, double thickness_px) {
  constexpr int kMaxPixels = 101;  // Of something right before the lens.
  const int pixels = std::clamp(static_cast<int>(std::ceil(thickness_px)), 1, kMaxPixels);
  const cv::Mat square = cv::getStructuringElement(cv::MORPH_RECT, {pixels, pixels});
  const int anchor = pixels / 2;
  const int back = pixels - 1 - anchor;  // Else squares of even size would shift the rest.
  cv::Mat eroded;
  cv::erode(mask, eroded, square, {anchor, anchor});
  cv::Mat opened;
  cv::dilate(eroded, opened, square, {back, back});
  return opened;
}

std::optional<TrueBox> FindTrueBox(const cv::Mat& labels,
                                   const InstanceRecord& instance,
                                   const Rigid3& T_camera_world,
                                   const PinholeCamera& camera,
                                   const TrueBoxOptions& options) {
  constexpr double kNearest = 0.1;  // Metres.
  const Eigen::Vector3d centre = T_camera_world * instance.box.T_world_box.translation;
  const cv::Mat mask =
      WithoutThinParts(labels == static_cast<double>(instance.id),
                       options.min_thickness * camera.fx() / std::max(centre.z(), kNearest));
  const int num_pixels = cv::countNonZero(mask);
  if (num_pixels < options.min_trace) return std::nullopt;
  const cv::Rect rect = cv::boundingRect(mask);
  TrueBox result;
  result.box = {static_cast<float>(rect.x), static_cast<float>(rect.y),
                static_cast<float>(rect.x + rect.width), static_cast<float>(rect.y + rect.height)};
  result.is_hard =
      num_pixels < options.min_pixels ||
      std::min(result.box.width(), result.box.height()) < options.min_side ||
      num_pixels < options.min_visible_part * OutlineArea(instance.box, T_camera_world, camera);
  return result;
}

}  // namespace

std::vector<TrueBox> FindTrueBoxes(const cv::Mat& labels,
                                   const std::vector<InstanceRecord>& instances,
                                   const ClassTable& classes,
                                   const Rigid3& T_world_camera,
                                   const PinholeCamera& camera,
                                   const TrueBoxOptions& options) {
  SEMSLAM_CHECK(labels.type() == CV_16UC1) << "type " << labels.type();
  const Rigid3 T_camera_world = T_world_camera.Inverse();
  std::vector<TrueBox> boxes;
  for (const InstanceRecord& instance : instances) {
    const std::optional<int> class_id = classes.Find(instance.class_name);
    if (!class_id) continue;
    std::optional<TrueBox> box = FindTrueBox(labels, instance, T_camera_world, camera, options);
    if (!box) continue;
    box->class_id = *class_id;
    boxes.push_back(*box);
  }
  return boxes;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/viewer/orbit_camera.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace semslam {
namespace {

constexpr double kMaxElevation = 0.5 * std::numbers::pi;
constexpr double kMinDistance = 0.02;  // Metres.
constexpr double kMaxDistance = 1e4;

// As many of the points as a fit needs, spread evenly.
std::vector<Eigen::Vector3f> Thinned(std::span<const Eigen::Vector3f> points) {
  constexpr std::size_t kMaxPoints = 30000;
  const std::size_t step = std::max<std::size_t>(1, points.size() / kMaxPoints);
  std::vector<Eigen::Vector3f> thinned;
  for (std::size_t i = 0; i < points.size(); i += step) {
    if (points[i].allFinite()) thinned.push_back(points[i]);
  }
  return thinned;
}

}  // namespace

void OrbitCamera::SetDirection(double azimuth, double elevation) {
  azimuth_ = std::remainder(azimuth, 2 * std::numbers::pi);
  elevation_ = std::clamp(elevation, -kMaxElevation, kMaxElevation);
}

void OrbitCamera::SetFieldOfView(double field_of_view) {
  field_of_view_ = std::clamp(field_of_view, 0.05, 2.5);
}

void OrbitCamera::LookAt(const Eigen::Vector3d& target, double distance) {
  target_ = target;
  distance_ = std::clamp(distance, kMinDistance, kMaxDistance);
}

void OrbitCamera::Fit(std::span<const Eigen::Vector3f> points, int width, int height) {
  const std::vector<Eigen::Vector3f> thinned = Thinned(points);
  if (thinned.empty()) return;
  const Eigen::Matrix3f R_view_world = R_camera_world().cast<float>();
  const Eigen::Vector3f forward = R_view_world.row(2);
  const Eigen::Vector3f up = -R_view_world.row(1);
  const double horizontal = 2 * std::atan(0.5 * width / FocalLength(height));
  const ViewCamera camera =
      FitCamera(thinned, forward, up, static_cast<float>(horizontal), width, height);
  std::vector<float> depths;
  for (const Eigen::Vector3f& point : thinned) depths.push_back(camera.ToCamera(point).z());
  const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  const double distance = std::clamp<double>(*middle, kMinDistance, kMaxDistance);
  LookAt((camera.p_world + static_cast<float>(distance) * forward).cast<double>(), distance);
}

void OrbitCamera::Turn(double azimuth, double elevation) {
  SetDirection(azimuth_ + azimuth, elevation_ + elevation);
}

void OrbitCamera::Pan(double dx, double dy, int height) {
  const Eigen::Matrix3d R_view_world = R_camera_world();
  const double metres_per_pixel = distance_ / FocalLength(height);
  target_ -= metres_per_pixel * (dx * R_view_world.row(0) + dy * R_view_world.row(1)).transpose();
}

void OrbitCamera::Zoom(double factor) { LookAt(target_, distance_ * factor); }

Eigen::Matrix3d OrbitCamera::R_camera_world() const {
  const double c = std::cos(azimuth_);
  const double s = std::sin(azimuth_);
  const Eigen::Vector3d level = c * frame_.forward + s * frame_.right;
  const Eigen::Vector3d x = c * frame_.right - s * frame_.forward;
  const Eigen::Vector3d z = std::cos(elevation_) * level - std::sin(elevation_) * frame_.up;
  Eigen::Matrix3d R_view_world;
  R_view_world << x.transpose(), z.cross(x).transpose(), z.transpose();
  return R_view_world;
}

double OrbitCamera::FocalLength(int height) const {
  return 0.5 * height / std::tan(0.5 * field_of_view_);
}

ViewCamera OrbitCamera::At(int width, int height) const {
  const Eigen::Matrix3d R_view_world = R_camera_world();
  ViewCamera camera;
  camera.R_camera_world = R_view_world.cast<float>();
  camera.p_world = (target_ - distance_ * R_view_world.row(2).transpose()).cast<float>();
  camera.focal_length = static_cast<float>(FocalLength(height));
  camera.width = width;
  camera.height = height;
  return camera;
}

Eigen::Matrix4f ClipFromWorld(const ViewCamera& camera, float near, float far) {
  Eigen::Matrix4f clip_from_camera = Eigen::Matrix4f::Zero();
  // y and z change their signs: the camera looks along z with y down.
  clip_from_camera(0, 0) = 2 * camera.focal_length / static_cast<float>(camera.width);
  clip_from_camera(1, 1) = -2 * camera.focal_length / static_cast<float>(camera.height);
  clip_from_camera(2, 2) = (far + near) / (far - near);
  clip_from_camera(2, 3) = -2 * far * near / (far - near);
  clip_from_camera(3, 2) = 1;
  Eigen::Matrix4f camera_from_world = Eigen::Matrix4f::Identity();
  camera_from_world.topLeftCorner<3, 3>() = camera.R_camera_world;
  camera_from_world.topRightCorner<3, 1>() = -camera.R_camera_world * camera.p_world;
  return clip_from_camera * camera_from_world;
}

Eigen::Vector3d PixelRay(const ViewCamera& camera, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d center(0.5 * (camera.width - 1), 0.5 * (camera.height - 1));
  const Eigen::Vector2d offset = (pixel - center) / static_cast<double>(camera.focal_length);
  const Eigen::Vector3d ray(offset.x(), offset.y(), 1);
  return (camera.R_camera_world.cast<double>().transpose() * ray).normalized();
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/camera_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "semslam/base/check.h"
#include "semslam/render/hash.h"

namespace semslam {
namespace {

// Camera axes: z towards the target, x level, y downwards.
Eigen::Quaterniond LookAt(const Waypoint& view) {
  const Eigen::Vector3d forward = (view.p_world_target - view.p_world_eye).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d R_world_camera;
  R_world_camera << right, forward.cross(right), forward;
  return Eigen::Quaterniond(R_world_camera).normalized();
}

}  // namespace

CameraPath::CameraPath(std::vector<Waypoint> waypoints, const Options& options)
    : waypoints_(std::move(waypoints)), options_(options) {
  SEMSLAM_CHECK(waypoints_.size() >= 2) << "waypoints: " << waypoints_.size();
  SEMSLAM_CHECK(options_.seconds_per_waypoint > 0);
}

Rigid3 CameraPath::At(double seconds) const {
  const double time = std::max(0.0, seconds);
  const Waypoint view = ViewAt(time);
  const Eigen::Vector3d shift(SwayAt(0, time), SwayAt(1, time), SwayAt(2, time));
  const Eigen::Vector3d turn(SwayAt(3, time), SwayAt(4, time), SwayAt(5, time));
  return {(LookAt(view) * ExpSO3(options_.sway_angle * turn)).normalized(),
          view.p_world_eye + options_.sway_m * shift};
}

Waypoint CameraPath::ViewAt(double seconds) const {
  const auto count = static_cast<std::int64_t>(waypoints_.size());
  double position = std::max(0.0, seconds) / options_.seconds_per_waypoint;
  if (!options_.closed) position = std::min(position, static_cast<double>(count - 1));
  const auto segment = static_cast<std::int64_t>(std::floor(position));
  const double t = position - static_cast<double>(segment);
  const double weights[4] = {(1 - t) * (1 - t) * (1 - t) / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
                             (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6, t * t * t / 6};
  Waypoint result{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  for (std::int64_t k = 0; k < 4; ++k) {
    const std::int64_t index = segment + k - 1;
    const std::int64_t inside = options_.closed ? (index % count + count) % count
                                                : std::clamp<std::int64_t>(index, 0, count - 1);
    const Waypoint& waypoint = waypoints_[static_cast<std::size_t>(inside)];
    result.p_world_eye += weights[k] * waypoint.p_world_eye;
    result.p_world_target += weights[k] * waypoint.p_world_target;
  }
  return result;
}

double CameraPath::duration() const {
  return options_.seconds_per_waypoint *
         static_cast<double>(waypoints_.size() - (options_.closed ? 0 : 1));
}

double CameraPath::SwayAt(int channel, double seconds) const {
  constexpr int kWaves = 4;
  double sum = 0;
  for (int wave = 0; wave < kWaves; ++wave) {
    const std::uint64_t hash = HashOf(options_.seed, static_cast<std::uint64_t>(channel),
                                      static_cast<std::uint64_t>(wave));
    const double hertz = 0.5 + 2.5 * UnitFloat(hash);
    const double phase = 2.0 * std::numbers::pi * UnitFloat(MixBits(hash));
    sum += std::sin(2.0 * std::numbers::pi * hertz * seconds + phase) / (1.0 + hertz);
  }
  return sum;
}

}  // namespace semslam

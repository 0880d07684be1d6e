// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "semslam/geometry/rigid3.h"

namespace semslam {

// Where the camera is and what it looks at.
struct Waypoint {
  Eigen::Vector3d p_world_eye = Eigen::Vector3d::Zero();
  Eigen::Vector3d p_world_target = Eigen::Vector3d::UnitY();
};

// A smooth way of a camera held by hand: a uniform cubic B-spline near the waypoints (its
// acceleration has no jumps), level with the horizon, plus the small sways of a hand.
class CameraPath {
 public:
  struct Options {
    double seconds_per_waypoint = 1.0;
    bool closed = true;         // After the last waypoint comes the first; else the camera stops.
    double sway_m = 0.003;      // Amplitude of the hand's sways, 0.5 to 3 Hz.
    double sway_angle = 0.004;  // Radians.
    std::uint64_t seed = 1;     // Of the sways.
  };

  // At least two waypoints, none of them looking straight up or down.
  CameraPath(std::vector<Waypoint> waypoints, const Options& options);

  // T_world_camera at a time in seconds since the start; for times before it, the start's.
  Rigid3 At(double seconds) const;
  // The same without the sways.
  Waypoint ViewAt(double seconds) const;
  // Seconds from the first waypoint to the last, or around if it is closed.
  double duration() const;

 private:
  // One of six independent sways, with an amplitude of about 1.
  double SwayAt(int channel, double seconds) const;

  std::vector<Waypoint> waypoints_;
  Options options_;
};

}  // namespace semslam

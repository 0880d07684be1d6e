// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include <Eigen/Core>

#include "semslam/geometry/rigid3.h"
#include "semslam/optim/camera_model.h"
#include "semslam/optim/pose_optimizer.h"

namespace semslam {

// A known point whose measurement was freed from the rolling shutter for some readout time.
struct ReadoutObservation {
  PoseObservation point;
  // What (u, v, right_x) of the measurement change by if the readout time grows by a second.
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();
};

struct ReadoutFit {
  double correction = 0;   // Seconds to add to the readout time.
  double information = 0;  // 1 / s^2: inverse of the correction's variance; 0: nothing is known.
};

// How much longer the readout was than assumed: a Gauss-Newton step over pose and readout together
// on the observations that agree with the pose (chi-squared limits), of which the readout's part is
// given. The pose takes what it can explain, so a motion that shifts all rows alike tells nothing.
ReadoutFit FitReadout(const StereoCamera& camera,
                      const Rigid3& T_world_camera,
                      std::span<const ReadoutObservation> observations,
                      const Chi2Limits& limits = {});

}  // namespace semslam

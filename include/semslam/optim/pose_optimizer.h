// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "semslam/geometry/rigid3.h"
#include "semslam/optim/camera_model.h"

namespace semslam {

// A point that is taken as known, and where the frame saw it.
struct PoseObservation {
  Eigen::Vector3d p_world = Eigen::Vector3d::Zero();  // Metres.
  ImagePoint image = {};
};

struct PoseOptions {
  int num_rounds = 4;             // Inliers are chosen anew before each but the first.
  int num_robust_rounds = 2;      // The first rounds have a Huber kernel, the others none.
  int iterations_per_round = 10;  // At most.
  Chi2Limits chi2 = {};
  // A round ends when a step lowers the cost by less than this fraction.
  double relative_tolerance = 1e-6;

  // Throws std::logic_error for values that make no sense.
  void Validate() const;
};

struct PoseSolution {
  Rigid3 T_world_camera = {};
  std::vector<std::uint8_t> is_inlier = {};  // One an observation, at the final pose.
  int num_inliers = 0;
  double mean_chi2 = 0;    // Over the inliers, without kernel; 0 if there are none.
  int num_iterations = 0;  // Of all rounds.
};

// The camera pose that minimises the reprojection errors of known points, by Levenberg-Marquardt on
// the 6x6 normal equations. Outliers (chi-squared limit, behind the camera, or not finite) are
// looked for among all observations after every round, so that one thrown out may come back; rounds
// end early at a minimum whose inliers are just the observations it was made from. With
// fewer than three usable observations at any time: the initial pose and no inliers.
PoseSolution OptimizePose(const StereoCamera& camera,
                          const Rigid3& T_world_camera_initial,
                          std::span<const PoseObservation> observations,
                          const PoseOptions& options = {});

}  // namespace semslam

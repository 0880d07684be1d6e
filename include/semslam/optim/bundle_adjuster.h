// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "semslam/geometry/rigid3.h"
#include "semslam/optim/camera_model.h"

namespace semslam {

// Poses and points with the observations that tie them together. Poses and points are named by
// their places in the vectors. Every number must be finite. If no pose is fixed, the result is
// determined only up to a common rigid motion.
struct BundleProblem {
  struct Observation {
    int pose = 0;
    int point = 0;
    ImagePoint image;
  };

  StereoCamera camera = {};
  std::vector<Rigid3> T_world_camera = {};
  std::vector<std::uint8_t> pose_is_fixed = {};  // One a pose: 1 if the pose must not move.
  std::vector<Eigen::Vector3d> p_world = {};     // Metres.
  std::vector<Observation> observations = {};
};

struct BundleOptions {
  int robust_iterations = 5;  // With a Huber kernel, over all observations; at most.
  int plain_iterations = 10;  // Without, over what passed the outlier test; at most.
  Chi2Limits chi2 = {};
  // A phase ends when a step lowers the cost by less than this fraction.
  double relative_tolerance = 1e-6;
  int num_threads = 1;  // 0: as many as there are cores. The result does not depend on it.
  // Asked before every iteration, in the caller's thread; true ends the adjustment. May be empty.
  std::function<bool()> should_stop = {};

  // Throws std::logic_error for values that make no sense.
  void Validate() const;
};

struct BundleSolution {
  std::vector<Rigid3> T_world_camera = {};  // Fixed poses come back unchanged, to the bit.
  std::vector<Eigen::Vector3d> p_world =
      {};  // A point without inlier observations stays where it was.
  std::vector<std::uint8_t> is_inlier = {};  // One an observation, tested at the final state.
  bool stopped = false;                      // should_stop ended it; the state is the best so far.
  double initial_cost = 0;                   // Sum of Huber costs of all observations (chi-squared
  double final_cost = 0;                     // within the limits), before and after.
  int num_iterations = 0;
  double seconds = 0;
};

// Bundle adjustment: the poses and points that minimise the reprojection errors, by
// Levenberg-Marquardt with the points eliminated (Schur complement; Triggs et al. 2000). First with
// a Huber kernel; then outliers (chi-squared limit or behind the camera) are left out and the rest
// is adjusted without kernel; at the end every observation is tested once more.
BundleSolution AdjustBundle(const BundleProblem& problem, const BundleOptions& options = {});

}  // namespace semslam

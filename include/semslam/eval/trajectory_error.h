// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "semslam/base/time.h"
#include "semslam/geometry/rigid3.h"
#include "semslam/io/trajectory_io.h"

namespace semslam {

// How far an estimated trajectory is from the true one, as the TUM RGB-D benchmark measures it
// (Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012).
struct TrajectoryError {
  struct Distances {
    double rmse = 0;  // Metres.
    double mean = 0;
    double median = 0;
    double max = 0;
  };

  int num_estimates = 0;
  int num_pairs = 0;  // Estimates with a true pose near in time.

  // Absolute trajectory error: distances of the positions after the best rigid alignment.
  Distances absolute;
  Rigid3 T_truth_estimate;  // That alignment.
  // The best alignment of positions and orientations, as points 1 m from the cameras feel them: to
  // carry a map over. A short path alone leaves it open by more than a map's errors.
  Rigid3 T_truth_estimate_map;

  // Relative pose error: of the motion over the interval; zero pairs if the trajectory is shorter.
  int num_relative_pairs = 0;
  double relative_translation_rmse = 0;  // Metres.
  double relative_rotation_rmse_degrees = 0;

  // Of each pair.
  struct Pose {
    TimeNs time = 0;                                    // Of the estimate.
    Eigen::Vector3d p_truth = Eigen::Vector3d::Zero();  // In the world of the truth, metres.
    double distance = 0;                                // As in the absolute error.
  };
  std::vector<Pose> poses;

  double path_length = 0;  // Of the true positions of the pairs, metres.
};

struct TrajectoryErrorOptions {
  TimeNs max_time_difference = 20'000'000;   // Of a true and an estimated pose.
  TimeNs relative_interval = 1'000'000'000;  // Of the relative pose error.
  TimeNs relative_interval_tolerance = 60'000'000;
  void Validate() const;  // Throws std::invalid_argument.
};

// Both trajectories sorted by time, as ReadTrajectory returns them. Each estimate is compared with
// the true pose nearest in time. Throws InputError if fewer than three find one, or if the
// positions lie on one line, so that no alignment is determined.
TrajectoryError EvaluateTrajectory(const Trajectory& truth,
                                   const Trajectory& estimate,
                                   const TrajectoryErrorOptions& options = {});

}  // namespace semslam

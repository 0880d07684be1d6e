// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <utility>

#include "optim/bundle_solver.h"

namespace semslam::internal {
namespace {

BundleState Moved(const BundleState& state, const BundleIndex& index, const BundleStep& step) {
  BundleState moved = state;
  for (int i = 0; i < index.num_free_poses(); ++i) {
    Rigid3& pose = moved.T_world_camera[index.pose_of_free_pose[i]];
    pose = Retract(pose, step.poses.segment<6>(FirstRow(i)));
  }
  for (std::size_t i = 0; i < moved.p_world.size(); ++i) moved.p_world[i] += step.points[i];
  return moved;
}

}  // namespace

BundleRun MinimizeBundle(BundleSolver solver,
                         BundleState initial,
                         const BundleIndex& index,
                         int max_iterations,
                         double relative_tolerance,
                         const std::function<bool()>& should_stop) {
  BundleRun run{.state = std::move(initial)};
  Damping damping;
  double cost = solver.Cost(run.state);
  while (run.num_iterations < max_iterations && !damping.exhausted()) {
    if (should_stop && should_stop()) {
      run.stopped = true;
      break;
    }
    ++run.num_iterations;
    const std::optional<BundleStep> step = solver.Step(run.state, damping);
    if (!step || !std::isfinite(step->predicted_decrease)) {
      damping.StepRejected();
      continue;
    }
    if (step->predicted_decrease <= 0) break;  // At the minimum, to the last digit.

    BundleState trial = Moved(run.state, index, *step);
    const double trial_cost = solver.Cost(trial);
    const double decrease = cost - trial_cost;
    if (!(decrease > 0)) {
      // A step that promised nothing and brought nothing: this is the minimum.
      if (step->predicted_decrease <= relative_tolerance * cost) break;
      damping.StepRejected();
      continue;
    }
    const bool converged = decrease <= relative_tolerance * cost;
    damping.StepTaken(decrease, step->predicted_decrease);
    run.state = std::move(trial);
    cost = trial_cost;
    if (converged) break;
  }
  return run;
}

}  // namespace semslam::internal

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/optim/bundle_adjuster.h"

#include <cmath>
#include <utility>

#include "semslam/base/check.h"
#include "semslam/base/stopwatch.h"

#include "optim/bundle_index.h"
#include "optim/bundle_solver.h"
#include "optim/huber.h"
#include "optim/reprojection.h"

namespace semslam {
namespace {

using internal::BundleState;

bool IsFinite(const Rigid3& pose) {
  return pose.rotation.coeffs().allFinite() && pose.translation.allFinite();
}

bool IsFinite(const ImagePoint& image) {
  return image.pixel.allFinite() && std::isfinite(image.right_x) &&
         std::isfinite(image.inverse_variance);
}

void CheckProblem(const BundleProblem& problem) {
  SEMSLAM_CHECK(problem.pose_is_fixed.size() == problem.T_world_camera.size())
      << problem.pose_is_fixed.size() << " flags, " << problem.T_world_camera.size() << " poses";
  for (std::size_t i = 0; i < problem.T_world_camera.size(); ++i) {
    SEMSLAM_CHECK(IsFinite(problem.T_world_camera[i])) << "pose " << i;
  }
  for (std::size_t i = 0; i < problem.p_world.size(); ++i) {
    SEMSLAM_CHECK(problem.p_world[i].allFinite()) << "point " << i;
  }
  for (std::size_t i = 0; i < problem.observations.size(); ++i) {
    const auto& [pose, point, image] = problem.observations[i];
    SEMSLAM_CHECK(pose >= 0 && static_cast<std::size_t>(pose) < problem.T_world_camera.size())
        << "observation " << i << ", pose " << pose;
    SEMSLAM_CHECK(point >= 0 && static_cast<std::size_t>(point) < problem.p_world.size())
        << "observation " << i << ", point " << point;
    SEMSLAM_CHECK(IsFinite(image) && image.inverse_variance > 0) << "observation " << i;
  }
}

// What the observations look like at a state.
struct Verdict {
  std::vector<std::uint8_t> is_inlier;
  double robust_cost = 0;
};

Verdict Judge(const BundleProblem& problem, const BundleState& state, const Chi2Limits& limits) {
  std::vector<Rigid3> T_camera_world;
  for (const Rigid3& pose : state.T_world_camera) T_camera_world.push_back(pose.Inverse());
  Verdict verdict{.is_inlier = std::vector<std::uint8_t>(problem.observations.size())};
  for (std::size_t i = 0; i < problem.observations.size(); ++i) {
    const auto& [pose, point, image] = problem.observations[i];
    const Eigen::Vector3d p_camera = T_camera_world[pose] * state.p_world[point];
    const double limit = limits.Of(image);
    const double chi2 = internal::ReprojectionChi2(problem.camera, p_camera, image);
    verdict.is_inlier[i] = internal::IsInFront(p_camera) && chi2 <= limit;
    verdict.robust_cost += internal::Huber(chi2, limit).cost;
  }
  return verdict;
}

}  // namespace

void BundleOptions::Validate() const {
  SEMSLAM_CHECK(robust_iterations >= 0) << "robust_iterations = " << robust_iterations;
  SEMSLAM_CHECK(plain_iterations >= 0) << "plain_iterations = " << plain_iterations;
  SEMSLAM_CHECK(chi2.without_depth > 0 && chi2.with_depth > 0)
      << "chi2 = " << chi2.without_depth << ", " << chi2.with_depth;
  SEMSLAM_CHECK(relative_tolerance >= 0) << "relative_tolerance = " << relative_tolerance;
  SEMSLAM_CHECK(num_threads >= 0) << "num_threads = " << num_threads;
}

BundleSolution AdjustBundle(const BundleProblem& problem, const BundleOptions& options) {
  options.Validate();
  CheckProblem(problem);
  const Stopwatch stopwatch;
  BundleSolution solution;
  BundleState state{problem.T_world_camera, problem.p_world};

  const auto minimize = [&](const std::vector<std::uint8_t>& is_active, bool robust) {
    const internal::BundleIndex index = internal::MakeBundleIndex(problem, is_active, options.chi2);
    internal::BundleRun run = internal::MinimizeBundle(
        internal::BundleSolver(problem.camera, index, robust, options.num_threads),
        std::move(state), index, robust ? options.robust_iterations : options.plain_iterations,
        options.relative_tolerance, options.should_stop);
    state = std::move(run.state);
    solution.num_iterations += run.num_iterations;
    solution.stopped = run.stopped;
  };

  solution.initial_cost = Judge(problem, state, options.chi2).robust_cost;
  minimize(std::vector<std::uint8_t>(problem.observations.size(), 1), true);
  if (!solution.stopped) minimize(Judge(problem, state, options.chi2).is_inlier, false);

  Verdict verdict = Judge(problem, state, options.chi2);
  solution.final_cost = verdict.robust_cost;
  solution.is_inlier = std::move(verdict.is_inlier);
  solution.T_world_camera = std::move(state.T_world_camera);
  solution.p_world = std::move(state.p_world);
  solution.seconds = stopwatch.Seconds();
  return solution;
}

}  // namespace semslam

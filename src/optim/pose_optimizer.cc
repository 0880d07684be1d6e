// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/optim/pose_optimizer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

#include "semslam/base/check.h"

#include "optim/damping.h"
#include "optim/pose_terms.h"
#include "optim/reprojection.h"

namespace semslam {
namespace {

using internal::Matrix6d;
using internal::PoseTerms;

constexpr int kMinObservations = 3;  // Fewer do not determine a pose.

bool IsUsable(const PoseObservation& observation) {
  const ImagePoint& image = observation.image;
  return observation.p_world.allFinite() && image.pixel.allFinite() &&
         std::isfinite(image.right_x) && std::isfinite(image.inverse_variance) &&
         image.inverse_variance > 0;
}

struct RoundResult {
  Rigid3 T_world_camera;
  int num_iterations = 0;
  bool converged = false;
};

// Levenberg-Marquardt over the given terms.
RoundResult Minimize(const StereoCamera& camera,
                     const Rigid3& T_world_camera_initial,
                     const PoseTerms& terms,
                     bool robust,
                     const PoseOptions& options) {
  RoundResult result{.T_world_camera = T_world_camera_initial};
  internal::Damping damping;
  PoseTerms::Linearization current = terms.Linearize(camera, result.T_world_camera, robust);
  while (result.num_iterations < options.iterations_per_round && !damping.exhausted()) {
    ++result.num_iterations;
    const Vector6d gradient = current.equations.Gradient();
    Matrix6d hessian = current.equations.Hessian();
    Vector6d damping_diagonal;
    for (int i = 0; i < 6; ++i) damping_diagonal[i] = damping.Of(hessian(i, i));
    hessian.diagonal() += damping_diagonal;
    const Vector6d step = hessian.ldlt().solve(-gradient);
    const double predicted = step.dot(damping_diagonal.cwiseProduct(step) - gradient);
    if (!(predicted > 0)) {  // At the minimum, to the last digit.
      result.converged = true;
      break;
    }

    const Rigid3 T_trial = Retract(result.T_world_camera, step);
    const PoseTerms::Linearization trial = terms.Linearize(camera, T_trial, robust);
    const double decrease = current.cost - trial.cost;
    if (!(decrease > 0)) {
      // A step that promised nothing and brought nothing: this is the minimum.
      result.converged = predicted <= options.relative_tolerance * current.cost;
      if (result.converged) break;
      damping.StepRejected();
      continue;
    }
    result.converged = decrease <= options.relative_tolerance * current.cost;
    damping.StepTaken(decrease, predicted);
    result.T_world_camera = T_trial;
    current = trial;
    if (result.converged) break;
  }
  return result;
}

// Tests all observations at a pose.
PoseSolution Judge(const StereoCamera& camera,
                   const Rigid3& T_world_camera,
                   std::span<const PoseObservation> observations,
                   const Chi2Limits& limits) {
  PoseSolution solution{.T_world_camera = T_world_camera,
                        .is_inlier = std::vector<std::uint8_t>(observations.size(), 0)};
  const Rigid3 T_camera_world = T_world_camera.Inverse();
  const Eigen::Matrix3d rotation = T_camera_world.rotation.toRotationMatrix();
  double sum = 0;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    if (!IsUsable(observations[i])) continue;
    const ImagePoint& image = observations[i].image;
    const Eigen::Vector3d p_camera =
        rotation * observations[i].p_world + T_camera_world.translation;
    const double chi2 = internal::ReprojectionChi2(camera, p_camera, image);
    if (!(chi2 <= limits.Of(image)) || !internal::IsInFront(p_camera)) continue;
    solution.is_inlier[i] = 1;
    ++solution.num_inliers;
    sum += chi2;
  }
  if (solution.num_inliers > 0) solution.mean_chi2 = sum / solution.num_inliers;
  return solution;
}

// The first round takes all that the camera could see at all.
std::vector<std::uint8_t> InFront(const Rigid3& T_world_camera,
                                  std::span<const PoseObservation> observations) {
  const Rigid3 T_camera_world = T_world_camera.Inverse();
  std::vector<std::uint8_t> in_front(observations.size());
  for (std::size_t i = 0; i < observations.size(); ++i) {
    in_front[i] =
        IsUsable(observations[i]) && internal::IsInFront(T_camera_world * observations[i].p_world);
  }
  return in_front;
}

PoseSolution Failure(const Rigid3& T_world_camera_initial, std::size_t num_observations) {
  return {.T_world_camera = T_world_camera_initial,
          .is_inlier = std::vector<std::uint8_t>(num_observations, 0)};
}

}  // namespace

void PoseOptions::Validate() const {
  SEMSLAM_CHECK(num_rounds >= 1) << "num_rounds = " << num_rounds;
  SEMSLAM_CHECK(num_robust_rounds >= 0) << "num_robust_rounds = " << num_robust_rounds;
  SEMSLAM_CHECK(iterations_per_round >= 1) << "iterations_per_round = " << iterations_per_round;
  SEMSLAM_CHECK(chi2.without_depth > 0 && chi2.with_depth > 0)
      << "chi2 = " << chi2.without_depth << ", " << chi2.with_depth;
  SEMSLAM_CHECK(relative_tolerance >= 0) << "relative_tolerance = " << relative_tolerance;
}

PoseSolution OptimizePose(const StereoCamera& camera,
                          const Rigid3& T_world_camera_initial,
                          std::span<const PoseObservation> observations,
                          const PoseOptions& options) {
  options.Validate();
  PoseSolution solution{.T_world_camera = T_world_camera_initial,
                        .is_inlier = InFront(T_world_camera_initial, observations)};
  PoseTerms terms;
  terms.Reserve(observations.size());
  for (int round = 0; round < options.num_rounds; ++round) {
    terms.Clear();
    for (std::size_t i = 0; i < observations.size(); ++i) {
      if (!solution.is_inlier[i]) continue;
      terms.Add(observations[i], options.chi2.Of(observations[i].image));
    }
    if (terms.size() < kMinObservations) {
      return Failure(T_world_camera_initial, observations.size());
    }
    const RoundResult result = Minimize(camera, solution.T_world_camera, terms,
                                        round < options.num_robust_rounds, options);
    PoseSolution judged = Judge(camera, result.T_world_camera, observations, options.chi2);
    judged.num_iterations = solution.num_iterations + result.num_iterations;
    // A minimum over just those that are its inliers: with or without kernel, further rounds would
    // stay in it.
    const bool is_final = result.converged && judged.is_inlier == solution.is_inlier;
    solution = std::move(judged);
    if (is_final) break;
  }
  if (solution.num_inliers < kMinObservations) {
    return Failure(T_world_camera_initial, observations.size());
  }
  return solution;
}

}  // namespace semslam

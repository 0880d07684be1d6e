// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "semslam/optim/bundle_adjuster.h"

#include "optim/bundle_index.h"
#include "optim/camera_system.h"
#include "optim/damping.h"
#include "optim/pose_normal_equations.h"
#include "optim/reprojection.h"

namespace semslam::internal {

// What the adjustment moves.
struct BundleState {
  std::vector<Rigid3> T_world_camera;
  std::vector<Eigen::Vector3d> p_world;
};

struct BundleStep {
  Eigen::VectorXd poses;  // Six numbers a free pose.
  std::vector<Eigen::Vector3d> points;
  double predicted_decrease = 0;  // Of the cost, by the linear model.
};

// One linear step of bundle adjustment, with the points eliminated. With the normal equations
//   | B  W | |dc|     |b_c|        B: 6x6 blocks, one a free pose,
//   | W' C | |dp| = - |b_p|        C: 3x3 blocks, one a point,
// damped to B', C' and with Cholesky factors C' = L L', V = W L^-T, v = L^-1 b_p:
//   (B' - V V') dc = -(b_c - V v),   dp = -L^-T (v + V' dc).
// One pass, point by point, builds the reduced system, so that all that belongs to a point is used
// while it is in the cache. The points are cut into parts, always the same ones, that are summed up
// one after the other: the result does not depend on the number of threads.
class BundleSolver {
 public:
  // Keeps references to camera and index.
  BundleSolver(const StereoCamera& camera, const BundleIndex& index, bool robust, int num_threads);

  // Sum of (robust) squared errors.
  double Cost(const BundleState& state) const;
  // Nothing if the reduced system cannot be solved: then more damping is called for.
  std::optional<BundleStep> Step(const BundleState& state, const Damping& damping);

 private:
  struct PointFactor {
    // False if the point is not observed: it stays in place and adds nothing.
    bool valid = false;
    Eigen::Matrix3d inverse_lower;  // L^-1.
    Eigen::Vector3d forward;        // v.
    Eigen::Vector3d gradient;       // b_p.
    Eigen::Vector3d damping;        // C' - C.
  };
  // The sums over one part of the points.
  struct Part {
    std::vector<PoseNormalEquations> equations;  // B and b_c, one a free pose.
    std::vector<Matrix6d> reduction;             // V V', one a block of the camera system.
    std::vector<Vector6d> right_reduction;       // V v, one a free pose.
  };

  void BuildPart(const BundleState& state,
                 const std::vector<Eigen::Matrix3d>& R_world_camera,
                 const Damping& damping,
                 int part);
  void LinearizePoint(const BundleState& state,
                      const std::vector<Eigen::Matrix3d>& R_world_camera,
                      const Damping& damping,
                      int point,
                      Part* part);
  void ReducePoint(int point, Part* part) const;
  void SumParts(const Damping& damping);
  BundleStep BackSubstitute(Eigen::VectorXd pose_step) const;

  const StereoCamera& camera_;
  const BundleIndex& index_;
  const bool robust_;
  const int num_threads_;
  std::vector<Matrix63d> v_;          // V, one a slot; not set for fixed poses.
  std::vector<PointFactor> factors_;  // One a point.
  std::vector<Part> parts_;
  CameraSystem system_;
  Eigen::VectorXd pose_gradient_;  // b_c.
  Eigen::VectorXd pose_damping_;   // B' - B.
};

// Levenberg-Marquardt from `initial`; `max_iterations` linear steps at most.
struct BundleRun {
  BundleState state;
  int num_iterations = 0;
  bool stopped = false;
};
BundleRun MinimizeBundle(BundleSolver solver,
                         BundleState initial,
                         const BundleIndex& index,
                         int max_iterations,
                         double relative_tolerance,
                         const std::function<bool()>& should_stop);

}  // namespace semslam::internal

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "optim/bundle_solver.h"

#include <cmath>

#include "semslam/base/parallel.h"

#include "optim/huber.h"
#include "optim/pose_normal_equations.h"

namespace semslam::internal {
namespace {

constexpr std::size_t kPointsPerChunk = 256;

std::vector<Eigen::Matrix3d> Rotations(const std::vector<Rigid3>& poses) {
  std::vector<Eigen::Matrix3d> rotations;
  rotations.reserve(poses.size());
  for (const Rigid3& pose : poses) rotations.push_back(pose.rotation.toRotationMatrix());
  return rotations;
}

// The lower Cholesky factor of a symmetric 3x3 matrix. The caller's damping keeps it definite.
Eigen::Matrix3d CholeskyFactor(const Eigen::Matrix3d& m) {
  Eigen::Matrix3d l = Eigen::Matrix3d::Zero();
  l(0, 0) = std::sqrt(m(0, 0));
  l(1, 0) = m(1, 0) / l(0, 0);
  l(2, 0) = m(2, 0) / l(0, 0);
  l(1, 1) = std::sqrt(m(1, 1) - l(1, 0) * l(1, 0));
  l(2, 1) = (m(2, 1) - l(2, 0) * l(1, 0)) / l(1, 1);
  l(2, 2) = std::sqrt(m(2, 2) - l(2, 0) * l(2, 0) - l(2, 1) * l(2, 1));
  return l;
}

}  // namespace

BundleSolver::BundleSolver(const StereoCamera& camera,
                           const BundleIndex& index,
                           bool robust,
                           int num_threads)
    : camera_(camera),
      index_(index),
      robust_(robust),
      num_threads_(num_threads),
      terms_(index.slots.size()),
      v_(index.slots.size()),
      factors_(index.num_points()),
      system_(index),
      pose_gradient_(6 * index.num_free_poses()),
      pose_damping_(6 * index.num_free_poses()) {}

double BundleSolver::Cost(const BundleState& state) const {
  const std::vector<Eigen::Matrix3d> R_world_camera = Rotations(state.T_world_camera);
  double cost = 0;
  for (const BundleIndex::Slot& slot : index_.slots) {
    const Eigen::Vector3d p_camera =
        R_world_camera[slot.pose].transpose() *
        (state.p_world[slot.point] - state.T_world_camera[slot.pose].translation);
    const double chi2 = ReprojectionChi2(camera_, p_camera, slot.image);
    cost += robust_ ? Huber(chi2, slot.limit).cost : chi2;
  }
  return cost;
}

void BundleSolver::EliminatePoint(const BundleState& state,
                                  const std::vector<Eigen::Matrix3d>& R_world_camera,
                                  const Damping& damping,
                                  int point) {
  const int first = index_.first_slot_of_point[point];
  const int first_free = index_.first_free_slot_of_point[point];
  const int end = index_.first_slot_of_point[point + 1];
  PointFactor& factor = factors_[point];
  factor.valid = false;
  factor.gradient.setZero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  for (int s = first; s < end; ++s) {
    const BundleIndex::Slot& slot = index_.slots[s];
    const Eigen::Matrix3d& rotation = R_world_camera[slot.pose];
    const Eigen::Vector3d p_camera =
        rotation.transpose() * (state.p_world[point] - state.T_world_camera[slot.pose].translation);
    ReprojectionTerm& term = terms_[s];
    if (!IsInFront(p_camera)) {
      term = ReprojectionTerm{};
      v_[s].setZero();
      continue;
    }
    factor.valid = true;
    term = LinearizeReprojection(camera_, p_camera, slot.image);
    if (robust_ && term.chi2 > slot.limit) term.Scale(Huber(term.chi2, slot.limit).weight);
    const Eigen::Matrix3d information_world = term.Information() * rotation.transpose();
    hessian.noalias() += rotation * information_world;
    factor.gradient.noalias() += rotation * term.gradient;
    if (s < first_free) continue;
    for (int c = 0; c < 3; ++c) {
      v_[s].col(c).head<3>() = information_world.col(c).cross(p_camera);
    }
    v_[s].bottomRows<3>() = -information_world;
  }
  if (!factor.valid) return;
  for (int i = 0; i < 3; ++i) factor.damping[i] = damping.Of(hessian(i, i));
  hessian.diagonal() += factor.damping;
  factor.lower = CholeskyFactor(hessian);
  const Eigen::Matrix3d inverse_lower =
      factor.lower.triangularView<Eigen::Lower>().solve(Eigen::Matrix3d::Identity());
  factor.forward = inverse_lower * factor.gradient;
  for (int s = first_free; s < end; ++s) v_[s] = v_[s] * inverse_lower.transpose();
}

void BundleSolver::ReducePose(const Damping& damping, int free_pose) {
  system_.SetRowToZero(free_pose);
  PoseNormalEquations equations;
  Vector6d reduction = Vector6d::Zero();
  const int end = index_.first_of_free_pose[free_pose + 1];
  for (int i = index_.first_of_free_pose[free_pose]; i < end; ++i) {
    const int s = index_.slots_of_free_pose[i];
    const int point = index_.slots[s].point;
    equations.Add(terms_[s]);
    if (!factors_[point].valid) continue;
    reduction.noalias() += v_[s] * factors_[point].forward;
    const int end_of_point = index_.first_slot_of_point[point + 1];
    for (int other = s; other < end_of_point; ++other) {
      const int other_pose = index_.slots[other].free_pose;
      Matrix6d& block = system_.Block(free_pose, other_pose);
      block.noalias() -= v_[s].lazyProduct(v_[other].transpose());
      if (other_pose == free_pose && other != s) {  // A pose that saw the point twice.
        block.noalias() -= v_[other].lazyProduct(v_[s].transpose());
      }
    }
  }
  Matrix6d hessian = equations.Hessian();
  for (int i = 0; i < 6; ++i) {
    pose_damping_[6 * free_pose + i] = damping.Of(hessian(i, i));
    hessian(i, i) += pose_damping_[6 * free_pose + i];
  }
  const Vector6d gradient = equations.Gradient();
  pose_gradient_.segment<6>(6 * free_pose) = gradient;
  system_.Block(free_pose, free_pose) += hessian;
  system_.right_side().segment<6>(6 * free_pose) = gradient - reduction;
}

Eigen::Vector3d BundleSolver::BackSubstitute(const Eigen::VectorXd& pose_step, int point) const {
  const PointFactor& factor = factors_[point];
  if (!factor.valid) return Eigen::Vector3d::Zero();
  Eigen::Vector3d right_side = factor.forward;
  const int end = index_.first_slot_of_point[point + 1];
  for (int s = index_.first_free_slot_of_point[point]; s < end; ++s) {
    right_side.noalias() += v_[s].transpose() * pose_step.segment<6>(6 * index_.slots[s].free_pose);
  }
  return -factor.lower.transpose().triangularView<Eigen::Upper>().solve(right_side);
}

std::optional<BundleStep> BundleSolver::Step(const BundleState& state, const Damping& damping) {
  const std::vector<Eigen::Matrix3d> R_world_camera = Rotations(state.T_world_camera);
  const std::size_t num_points = state.p_world.size();
  ParallelFor(num_points, kPointsPerChunk, num_threads_, [&](std::size_t first, std::size_t last) {
    for (std::size_t point = first; point < last; ++point) {
      EliminatePoint(state, R_world_camera, damping, static_cast<int>(point));
    }
  });
  ParallelFor(system_.num_poses(), 1, num_threads_, [&](std::size_t first, std::size_t last) {
    for (std::size_t pose = first; pose < last; ++pose) ReducePose(damping, static_cast<int>(pose));
  });

  BundleStep step;
  if (system_.num_poses() > 0) {
    std::optional<Eigen::VectorXd> poses = system_.Solve();
    if (!poses) return std::nullopt;
    step.poses = std::move(*poses);
    step.predicted_decrease =
        step.poses.dot(pose_damping_.cwiseProduct(step.poses) - pose_gradient_);
  }
  step.points.resize(num_points);
  for (std::size_t point = 0; point < num_points; ++point) {
    step.points[point] = BackSubstitute(step.poses, static_cast<int>(point));
    const PointFactor& factor = factors_[point];
    if (!factor.valid) continue;
    step.predicted_decrease +=
        step.points[point].dot(factor.damping.cwiseProduct(step.points[point]) - factor.gradient);
  }
  return step;
}

}  // namespace semslam::internal

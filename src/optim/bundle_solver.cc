// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "optim/bundle_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "semslam/base/parallel.h"

#include "optim/huber.h"

namespace semslam::internal {
namespace {

// The points are summed up in so many parts, which is also the most threads that can help. A part
// has a reduced system of its own, so small problems are not cut.
constexpr int kMaxParts = 4;
constexpr int kMinPointsPerPart = 250;

std::vector<Eigen::Matrix3d> Rotations(const std::vector<Rigid3>& poses) {
  std::vector<Eigen::Matrix3d> rotations;
  rotations.reserve(poses.size());
  for (const Rigid3& pose : poses) rotations.push_back(pose.rotation.toRotationMatrix());
  return rotations;
}

// A column of M R^T, for a row of R.
Eigen::Vector3d InformationTimes(const ReprojectionTerm& term, const Eigen::RowVector3d& row) {
  return {term.m00 * row[0] + term.m02 * row[2], term.m11 * row[1] + term.m12 * row[2],
          term.m02 * row[0] + term.m12 * row[1] + term.m22 * row[2]};
}

// w * l^T in the place of w, for a lower triangle l.
void MultiplyByTransposeOf(const Eigen::Matrix3d& l, Matrix63d* w) {
  w->col(2) = w->col(0) * l(2, 0) + w->col(1) * l(2, 1) + w->col(2) * l(2, 2);
  w->col(1) = w->col(0) * l(1, 0) + w->col(1) * l(1, 1);
  w->col(0) *= l(0, 0);
}

// The inverse of the lower Cholesky factor of a symmetric 3x3 matrix of which the upper triangle is
// given. The caller's damping keeps it definite; the result is not finite otherwise.
Eigen::Matrix3d InverseCholeskyFactor(const Eigen::Matrix3d& m) {
  const double i00 = 1.0 / std::sqrt(m(0, 0));
  const double l10 = m(0, 1) * i00;
  const double l20 = m(0, 2) * i00;
  const double i11 = 1.0 / std::sqrt(m(1, 1) - l10 * l10);
  const double l21 = (m(1, 2) - l20 * l10) * i11;
  const double i22 = 1.0 / std::sqrt(m(2, 2) - l20 * l20 - l21 * l21);
  const double i10 = -l10 * i00 * i11;
  Eigen::Matrix3d inverse;
  inverse << i00, 0, 0, i10, i11, 0, -(l20 * i00 + l21 * i10) * i22, -l21 * i11 * i22, i22;
  return inverse;
}

// sum += a * b^T, in an order that keeps a in registers.
void AddProduct(const Matrix63d& a, const Matrix63d& b, Matrix6d* sum) {
  const Vector6d a0 = a.col(0);
  const Vector6d a1 = a.col(1);
  const Vector6d a2 = a.col(2);
  for (int c = 0; c < 6; ++c) sum->col(c) += a0 * b(c, 0) + a1 * b(c, 1) + a2 * b(c, 2);
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
      v_(index.slots.size()),
      factors_(index.num_points()),
      parts_(std::clamp(index.num_points() / kMinPointsPerPart, 1, kMaxParts)),
      system_(index),
      pose_gradient_(FirstRow(index.num_free_poses())),
      pose_damping_(FirstRow(index.num_free_poses())) {}

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

// B, C', W (in the place of V) and the gradients of one point.
void BundleSolver::LinearizePoint(const BundleState& state,
                                  const std::vector<Eigen::Matrix3d>& R_world_camera,
                                  const Damping& damping,
                                  int point,
                                  Part* part) {
  const int first_free = index_.first_free_slot_of_point[point];
  const int end = index_.first_slot_of_point[point + 1];
  PointFactor& factor = factors_[point];
  factor.valid = false;
  factor.gradient.setZero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  for (int s = index_.first_slot_of_point[point]; s < end; ++s) {
    const BundleIndex::Slot& slot = index_.slots[s];
    const Eigen::Matrix3d& rotation = R_world_camera[slot.pose];
    const Eigen::Vector3d p_camera =
        rotation.transpose() * (state.p_world[point] - state.T_world_camera[slot.pose].translation);
    if (!IsInFront(p_camera)) {
      v_[s].setZero();
      continue;
    }
    factor.valid = true;
    ReprojectionTerm term = LinearizeReprojection(camera_, p_camera, slot.image);
    if (robust_ && term.chi2 > slot.limit) term.Scale(Huber(term.chi2, slot.limit).weight);
    factor.gradient.noalias() += rotation * term.gradient();
    if (s >= first_free) part->equations[slot.free_pose].Add(term);
    for (int c = 0; c < 3; ++c) {
      const Eigen::Vector3d column = InformationTimes(term, rotation.row(c));
      for (int r = 0; r <= c; ++r) hessian(r, c) += rotation.row(r).dot(column);
      if (s < first_free) continue;
      v_[s].col(c) << column.cross(p_camera), -column;
    }
  }
  if (!factor.valid) return;
  for (int i = 0; i < 3; ++i) factor.damping[i] = damping.Of(hessian(i, i));
  hessian.diagonal() += factor.damping;
  factor.inverse_lower = InverseCholeskyFactor(hessian);
  factor.forward = factor.inverse_lower * factor.gradient;
  for (int s = first_free; s < end; ++s) MultiplyByTransposeOf(factor.inverse_lower, &v_[s]);
}

// V V' and V v of one point.
void BundleSolver::ReducePoint(int point, Part* part) const {
  if (!factors_[point].valid) return;
  const int end = index_.first_slot_of_point[point + 1];
  for (int a = index_.first_free_slot_of_point[point]; a < end; ++a) {
    const int pose_a = index_.slots[a].free_pose;
    part->right_reduction[pose_a].noalias() += v_[a] * factors_[point].forward;
    for (int b = a; b < end; ++b) {
      const int pose_b = index_.slots[b].free_pose;
      Matrix6d* block = &part->reduction[system_.BlockNumber(pose_a, pose_b)];
      AddProduct(v_[a], v_[b], block);
      // A pose that saw the point twice.
      if (pose_a == pose_b && a != b) AddProduct(v_[b], v_[a], block);
    }
  }
}

void BundleSolver::BuildPart(const BundleState& state,
                             const std::vector<Eigen::Matrix3d>& R_world_camera,
                             const Damping& damping,
                             int part_number) {
  Part& part = parts_[part_number];
  part.equations.assign(system_.num_poses(), {});
  part.reduction.assign(system_.num_blocks(), Matrix6d::Zero());
  part.right_reduction.assign(system_.num_poses(), Vector6d::Zero());
  const std::size_t num_points = factors_.size();
  const auto end = static_cast<int>(num_points * (part_number + 1) / parts_.size());
  for (auto point = static_cast<int>(num_points * part_number / parts_.size()); point < end;
       ++point) {
    LinearizePoint(state, R_world_camera, damping, point, &part);
    ReducePoint(point, &part);
  }
}

void BundleSolver::SumParts(const Damping& damping) {
  std::vector<Matrix6d>& blocks = system_.blocks();
  for (Matrix6d& block : blocks) block.setZero();
  pose_gradient_.setZero();
  system_.right_side().setZero();
  for (const Part& part : parts_) {
    for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i] -= part.reduction[i];
  }
  for (int pose = 0; pose < system_.num_poses(); ++pose) {
    Matrix6d hessian = Matrix6d::Zero();
    auto gradient = pose_gradient_.segment<6>(FirstRow(pose));
    auto right_side = system_.right_side().segment<6>(FirstRow(pose));
    for (const Part& part : parts_) {
      hessian += part.equations[pose].Hessian();
      gradient += part.equations[pose].Gradient();
      right_side -= part.right_reduction[pose];
    }
    right_side += gradient;
    for (int i = 0; i < 6; ++i) {
      pose_damping_[FirstRow(pose) + i] = damping.Of(hessian(i, i));
      hessian(i, i) += pose_damping_[FirstRow(pose) + i];
    }
    blocks[system_.BlockNumber(pose, pose)] += hessian;
  }
}

BundleStep BundleSolver::BackSubstitute(Eigen::VectorXd pose_step) const {
  BundleStep step{.poses = std::move(pose_step),
                  .points = std::vector<Eigen::Vector3d>(factors_.size(), Eigen::Vector3d::Zero())};
  step.predicted_decrease = step.poses.dot(pose_damping_.cwiseProduct(step.poses) - pose_gradient_);
  for (std::size_t point = 0; point < factors_.size(); ++point) {
    const PointFactor& factor = factors_[point];
    if (!factor.valid) continue;
    Eigen::Vector3d right_side = factor.forward;
    const int end = index_.first_slot_of_point[point + 1];
    for (int s = index_.first_free_slot_of_point[point]; s < end; ++s) {
      right_side.noalias() +=
          v_[s].transpose() * step.poses.segment<6>(FirstRow(index_.slots[s].free_pose));
    }
    const Eigen::Vector3d move = -(factor.inverse_lower.transpose() * right_side);
    step.points[point] = move;
    step.predicted_decrease += move.dot(factor.damping.cwiseProduct(move) - factor.gradient);
  }
  return step;
}

std::optional<BundleStep> BundleSolver::Step(const BundleState& state, const Damping& damping) {
  const std::vector<Eigen::Matrix3d> R_world_camera = Rotations(state.T_world_camera);
  ParallelFor(parts_.size(), 1, num_threads_, [&](std::size_t first, std::size_t last) {
    for (std::size_t part = first; part < last; ++part) {
      BuildPart(state, R_world_camera, damping, static_cast<int>(part));
    }
  });
  SumParts(damping);
  if (system_.num_poses() == 0) return BackSubstitute(Eigen::VectorXd());
  std::optional<Eigen::VectorXd> pose_step = system_.Solve();
  if (!pose_step) return std::nullopt;
  return BackSubstitute(std::move(*pose_step));
}

}  // namespace semslam::internal

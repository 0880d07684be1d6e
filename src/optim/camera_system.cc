// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "optim/camera_system.h"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>

namespace semslam::internal {
namespace {

// Up to so many poses, and above so full, a dense factorisation is the faster one.
constexpr int kMaxPosesAlwaysDense = 40;
constexpr double kMinFillDense = 0.4;

}  // namespace

CameraSystem::CameraSystem(const BundleIndex& index)
    : num_poses_(index.num_free_poses()),
      block_of_pair_(static_cast<std::size_t>(num_poses_) * num_poses_, kNoBlock),
      right_side_(Eigen::VectorXd::Zero(FirstRow(num_poses_))) {
  constexpr int kPresent = 0;
  for (int pose = 0; pose < num_poses_; ++pose) block_of_pair_[Pair(pose, pose)] = kPresent;
  for (int point = 0; point < index.num_points(); ++point) {
    const int end = index.first_slot_of_point[point + 1];
    for (int a = index.first_free_slot_of_point[point]; a < end; ++a) {
      for (int b = a + 1; b < end; ++b) {
        block_of_pair_[Pair(index.slots[a].free_pose, index.slots[b].free_pose)] = kPresent;
      }
    }
  }
  int num_blocks = 0;
  for (int& block : block_of_pair_) {
    if (block == kPresent) block = num_blocks++;
  }
  blocks_.resize(num_blocks);
}

std::optional<Eigen::VectorXd> CameraSystem::Solve() const {
  const double num_pairs = 0.5 * num_poses_ * (num_poses_ + 1.0);
  const bool dense = num_poses_ <= kMaxPosesAlwaysDense ||
                     static_cast<double>(blocks_.size()) > kMinFillDense * num_pairs;
  std::optional<Eigen::VectorXd> solution = dense ? SolveDense() : SolveSparse();
  if (solution && !solution->allFinite()) return std::nullopt;
  return solution;
}

std::optional<Eigen::VectorXd> CameraSystem::SolveDense() const {
  // The lower triangle, which the factorisation reads, is the transpose of what is held.
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(FirstRow(num_poses_), FirstRow(num_poses_));
  for (int row = 0; row < num_poses_; ++row) {
    for (int column = row; column < num_poses_; ++column) {
      const int block = block_of_pair_[Pair(row, column)];
      if (block == kNoBlock) continue;
      matrix.block<6, 6>(FirstRow(column), FirstRow(row)) = blocks_[block].transpose();
    }
  }
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>, Eigen::Lower> factor(matrix);  // In place.
  if (factor.info() != Eigen::Success) return std::nullopt;
  return factor.solve(-right_side_);
}

std::optional<Eigen::VectorXd> CameraSystem::SolveSparse() const {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(36 * blocks_.size());
  for (int row = 0; row < num_poses_; ++row) {
    for (int column = row; column < num_poses_; ++column) {
      const int block = block_of_pair_[Pair(row, column)];
      if (block == kNoBlock) continue;
      for (int c = 0; c < 6; ++c) {
        const int last = row == column ? c : 5;
        for (int r = 0; r <= last; ++r) {
          entries.emplace_back(6 * row + r, 6 * column + c, blocks_[block](r, c));
        }
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(FirstRow(num_poses_), FirstRow(num_poses_));
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Upper> factor(matrix);
  if (factor.info() != Eigen::Success) return std::nullopt;
  return factor.solve(-right_side_);
}

}  // namespace semslam::internal

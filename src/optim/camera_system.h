// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "optim/bundle_index.h"
#include "optim/reprojection.h"

namespace semslam::internal {

// Where the six numbers of a free pose begin in vectors over all of them.
inline Eigen::Index FirstRow(int free_pose) { return Eigen::Index{6} * free_pose; }

// The reduced camera system S dx = -b: symmetric, positive definite, in 6x6 blocks, of which only
// those on and above the diagonal that can differ from zero are held (two poses with a common
// point).
class CameraSystem {
 public:
  explicit CameraSystem(const BundleIndex& index);

  int num_poses() const { return num_poses_; }
  int num_blocks() const { return static_cast<int>(blocks_.size()); }
  // Number of the block in this row and column of blocks; row <= column, and the poses share a
  // point.
  int BlockNumber(int row, int column) const { return block_of_pair_[Pair(row, column)]; }
  // Row by row.
  std::vector<Matrix6d>& blocks() { return blocks_; }
  // b.
  Eigen::VectorXd& right_side() { return right_side_; }

  // dx; nothing if S is not positive definite in the arithmetic of doubles.
  std::optional<Eigen::VectorXd> Solve() const;

 private:
  static constexpr int kNoBlock = -1;

  std::size_t Pair(int row, int column) const {
    return static_cast<std::size_t>(row) * num_poses_ + column;
  }
  std::optional<Eigen::VectorXd> SolveDense() const;
  std::optional<Eigen::VectorXd> SolveSparse() const;

  int num_poses_;
  std::vector<int> block_of_pair_;  // kNoBlock where the poses share no point.
  std::vector<Matrix6d> blocks_;
  Eigen::VectorXd right_side_;
};

}  // namespace semslam::internal

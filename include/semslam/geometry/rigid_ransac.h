// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "semslam/geometry/rigid3.h"

namespace semslam {

struct RansacOptions {
  double confidence = 0.99;  // That a sample without outliers was among those drawn.
  int max_iterations = 300;
  int min_inliers = 20;
  std::uint64_t seed = 1;
  void Validate() const;  // Throws std::logic_error.
};

struct RigidConsensus {
  Rigid3 T_a_b;
  std::vector<std::uint8_t> is_inlier;  // One a pair.
  int num_inliers = 0;
};

// The rigid motion on which most pairs agree, found from random samples of three pairs (Fischler
// and Bolles 1981, with AlignPoints on each sample), then fitted to all that agree. Whether a pair
// agrees with a motion, the caller says: `agrees(T_a_b, pair)`. The same pairs and seed give the
// same result. Nothing if fewer than min_inliers ever agree.
std::optional<RigidConsensus> FindRigidConsensus(
    std::span<const Eigen::Vector3d> points_a,
    std::span<const Eigen::Vector3d> points_b,
    const std::function<bool(const Rigid3& T_a_b, std::size_t pair)>& agrees,
    const RansacOptions& options);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "semslam/optim/bundle_adjuster.h"

namespace semslam::internal {

// The observations of a bundle problem that take part, in the order in which the solver walks them:
// point by point, and within a point those of fixed poses first, then by free pose. Free poses are
// numbered 0, 1, ... in the problem's order.
struct BundleIndex {
  static constexpr int kFixed = -1;

  struct Slot {
    int pose;       // In the problem.
    int free_pose;  // Number among the free poses, or kFixed.
    int point;
    double limit;  // Chi-squared.
    ImagePoint image;
  };

  std::vector<int> pose_of_free_pose;
  std::vector<Slot> slots;
  std::vector<int> first_slot_of_point;  // One more than points: the end of the last.
  std::vector<int> first_free_slot_of_point;
  std::vector<int> first_of_free_pose;  // Into slots_of_free_pose; one more than free poses.
  std::vector<int> slots_of_free_pose;  // Ascending for each pose.

  int num_free_poses() const { return static_cast<int>(pose_of_free_pose.size()); }
  int num_points() const { return static_cast<int>(first_slot_of_point.size()) - 1; }
};

// `is_active`: one an observation of the problem.
BundleIndex MakeBundleIndex(const BundleProblem& problem,
                            const std::vector<std::uint8_t>& is_active,
                            const Chi2Limits& limits);

}  // namespace semslam::internal

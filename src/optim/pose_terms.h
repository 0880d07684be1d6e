// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "semslam/geometry/rigid3.h"
#include "semslam/optim/pose_optimizer.h"

#include "optim/pose_normal_equations.h"

namespace semslam::internal {

// What a pose is found from, arranged for vector instructions: all numbers of four observations lie
// side by side.
class PoseTerms {
 public:
  struct Linearization {
    double cost = 0;
    PoseNormalEquations equations;
  };

  void Clear();
  void Reserve(std::size_t num_observations);
  // The squared error has a Huber kernel of width sqrt(limit).
  void Add(const PoseObservation& observation, double limit);

  std::size_t size() const { return size_; }
  // With or without the kernels.
  Linearization Linearize(const StereoCamera& camera,
                          const Rigid3& T_world_camera,
                          bool robust) const;

  static constexpr int kLanes = 4;
  using Four = std::array<double, kLanes>;
  // An observation that there is not has no weight.
  struct Block {
    Four x{}, y{}, z{};  // In the world.
    Four u{}, v{}, right_x{};
    Four weight{}, right_weight{};
    Four limit{};
  };

 private:
  std::vector<Block> blocks_;
  std::size_t size_ = 0;
};

}  // namespace semslam::internal

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "optim/pose_terms.h"

#include <cstddef>
#include <cstring>
#include <span>

#include "semslam/base/simd_clones.h"

#include "optim/huber.h"

namespace semslam::internal {
namespace {

using Block = PoseTerms::Block;
using Four = PoseTerms::Four;
constexpr int kLanes = PoseTerms::kLanes;
// GCC and Clang make vector instructions of it, of AVX, SSE2 or NEON; all give the same bits.
using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));

SEMSLAM_SIMD_INLINE Lanes Load(const Four& numbers) {
  Lanes lanes;
  std::memcpy(&lanes, numbers.data(), sizeof(lanes));
  return lanes;
}
SEMSLAM_SIMD_INLINE Four Store(const Lanes& lanes) {
  Four numbers;
  std::memcpy(numbers.data(), &lanes, sizeof(lanes));
  return numbers;
}
SEMSLAM_SIMD_INLINE double Sum(const Lanes& lanes) {
  return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}
template <std::size_t kCount>
SEMSLAM_SIMD_INLINE void SumEach(const Lanes (&lanes)[kCount], double (&sums)[kCount]) {
  for (std::size_t i = 0; i < kCount; ++i) sums[i] = Sum(lanes[i]);
}

// Costs and weights of a block under its kernels.
struct BlockCost {
  double cost = 0;
  Four weight = {1, 1, 1, 1};
};
BlockCost Robust(const Four& chi2, const Four& limit) {
  BlockCost result;
  for (int i = 0; i < kLanes; ++i) {
    const RobustCost huber = Huber(chi2[i], limit[i]);
    result.cost += huber.cost;
    result.weight[i] = huber.weight;
  }
  return result;
}

// The world as the camera sees it: rows of the rotation, and the translation.
struct View {
  Eigen::Matrix3d R_camera_world;
  Eigen::Vector3d t_camera_world;
};

struct Sums {
  double cost = 0;
  PoseSums<double> sums;
};

SEMSLAM_SIMD_CLONES Sums LinearizeBlocks(const StereoCamera& camera,
                                         const View& view,
                                         std::span<const Block> blocks,
                                         bool robust) {
  const Eigen::Matrix3d& r = view.R_camera_world;
  const Eigen::Vector3d& t = view.t_camera_world;
  const Lanes zero{};
  Sums result;
  PoseSums<Lanes> sums;
  Lanes costs{};
  for (const Block& block : blocks) {
    const Lanes world_x = Load(block.x);
    const Lanes world_y = Load(block.y);
    const Lanes world_z = Load(block.z);
    const Lanes x = r(0, 0) * world_x + r(0, 1) * world_y + r(0, 2) * world_z + t[0];
    const Lanes y = r(1, 0) * world_x + r(1, 1) * world_y + r(1, 2) * world_z + t[1];
    const Lanes z = r(2, 0) * world_x + r(2, 1) * world_y + r(2, 2) * world_z + t[2];
    const auto is_in_front = z > kMinDepth;
    const Lanes weight = Load(block.weight);
    const Sight<Lanes> sight{Load(block.u), Load(block.v), Load(block.right_x),
                             is_in_front ? weight : zero,
                             is_in_front ? Load(block.right_weight) : zero};
    const Lanes depth = is_in_front ? z : zero + 1.0;
    TermSums<Lanes> term = LinearizeSight(camera, x, y, depth, sight);
    const Lanes behind = weight > 0 ? zero + kBehindChi2 : zero;
    const Lanes chi2 = is_in_front ? term.chi2 : behind;
    const Lanes limit = Load(block.limit);
    const Lanes excess = chi2 > limit ? chi2 - limit : zero;
    if (robust && Sum(excess) > 0) {
      const BlockCost kernels = Robust(Store(chi2), Store(limit));
      result.cost += kernels.cost;
      term.Scale(Load(kernels.weight));
    } else {
      costs += chi2;
    }
    sums.Add(x, y, depth, term);
  }
  result.cost += Sum(costs);
  SumEach(sums.rotation, result.sums.rotation);
  SumEach(sums.mixed, result.sums.mixed);
  SumEach(sums.translation, result.sums.translation);
  SumEach(sums.gradient, result.sums.gradient);
  return result;
}

}  // namespace

void PoseTerms::Clear() {
  blocks_.clear();
  size_ = 0;
}

void PoseTerms::Reserve(std::size_t num_observations) {
  blocks_.reserve((num_observations + kLanes - 1) / kLanes);
}

void PoseTerms::Add(const PoseObservation& observation, double limit) {
  const std::size_t lane = size_++ % kLanes;
  if (lane == 0) blocks_.emplace_back();
  Block& block = blocks_.back();
  const ImagePoint& image = observation.image;
  block.x[lane] = observation.p_world.x();
  block.y[lane] = observation.p_world.y();
  block.z[lane] = observation.p_world.z();
  block.u[lane] = image.pixel.x();
  block.v[lane] = image.pixel.y();
  block.right_x[lane] = image.right_x;
  block.weight[lane] = image.inverse_variance;
  block.right_weight[lane] = image.has_right() ? image.inverse_variance : 0;
  block.limit[lane] = limit;
}

PoseTerms::Linearization PoseTerms::Linearize(const StereoCamera& camera,
                                              const Rigid3& T_world_camera,
                                              bool robust) const {
  View view;
  view.R_camera_world = T_world_camera.rotation.toRotationMatrix().transpose();
  view.t_camera_world = -(view.R_camera_world * T_world_camera.translation);
  const Sums sums = LinearizeBlocks(camera, view, blocks_, robust);
  return {sums.cost, PoseNormalEquations(sums.sums)};
}

}  // namespace semslam::internal

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/patch_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

namespace semslam {
namespace {

// A place on a curve that fills space (Morton 1966): the bits of the three coordinates in turn.
std::uint64_t CurvePlace(const Eigen::Vector3d& position) {
  constexpr double kCellsPerMetre = 10;
  constexpr int kBits = 20;
  std::uint64_t place = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = std::clamp(position[axis] * kCellsPerMetre, 0.0, double{(1 << kBits) - 1});
    const auto whole = static_cast<std::uint64_t>(cell);
    for (int bit = 0; bit < kBits; ++bit) place |= (whole >> bit & 1) << (3 * bit + axis);
  }
  return place;
}

// exp(-x) for 0 <= x <= 80, to six digits.
__m128 ExpOfMinus(__m128 x) {
  constexpr float kLog2OfE = 1.44269504F;
  // 2^y = 2^whole 2^part, part in -0.5 .. 0.5.
  const __m128 y = _mm_mul_ps(x, _mm_set1_ps(-kLog2OfE));
  const __m128i whole = _mm_cvtps_epi32(y);
  const __m128 part = _mm_sub_ps(y, _mm_cvtepi32_ps(whole));
  __m128 power = _mm_set1_ps(1.33335581e-3F);  // Taylor's series.
  for (const float coefficient :
       {9.61812911e-3F, 5.55041087e-2F, 2.40226507e-1F, 6.93147181e-1F, 1.0F}) {
    power = _mm_add_ps(_mm_mul_ps(power, part), _mm_set1_ps(coefficient));
  }
  constexpr int kExponentBit = 23;
  return _mm_castsi128_ps(
      _mm_add_epi32(_mm_castps_si128(power), _mm_slli_epi32(whole, kExponentBit)));
}

}  // namespace

double PatchTable::SoftSupport(const Plane& plane,
                               double tolerance,
                               double min_normal_cosine) const {
  constexpr double kMaxExponent = 10;
  constexpr float kWrongNormalFactor = 100.0F;
  const Reach reach = {2 * kMaxExponent * tolerance, min_normal_cosine};
  const FourPlane four(plane);
  const __m128 max_cost = _mm_set1_ps(static_cast<float>(reach.max_cost));
  const __m128 min_cosine = _mm_set1_ps(static_cast<float>(min_normal_cosine));
  const __m128 scale = _mm_set1_ps(static_cast<float>(1 / (2 * tolerance)));
  __m128d low = _mm_setzero_pd();
  __m128d high = _mm_setzero_pd();
  ForGroups(four, reach, [&](std::size_t group) {
    const __m128 distance = four.DistanceTo(groups_[group]);
    const __m128 agrees = _mm_cmpge_ps(four.CosineTo(groups_[group]), min_cosine);
    const __m128 cost =
        Choose(agrees, distance, _mm_mul_ps(distance, _mm_set1_ps(kWrongNormalFactor)));
    const __m128 is_near = _mm_cmple_ps(cost, max_cost);
    if (_mm_movemask_ps(is_near) == 0) return;
    const __m128 weight = ExpOfMinus(_mm_mul_ps(_mm_min_ps(cost, max_cost), scale));
    const __m128 support = _mm_and_ps(is_near, _mm_mul_ps(weight, Load(areas_[group].values)));
    low = _mm_add_pd(low, _mm_cvtps_pd(support));
    high = _mm_add_pd(high, _mm_cvtps_pd(_mm_movehl_ps(support, support)));
  });
  const __m128d sum = _mm_add_pd(low, high);
  return _mm_cvtsd_f64(sum) + _mm_cvtsd_f64(_mm_unpackhi_pd(sum, sum));
}

PatchTable::PatchTable(const std::vector<Patch>& patches) {
  constexpr float kNowhere = 1e30F;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  order.reserve(patches.size());
  for (const Patch& patch : patches) {
    order.emplace_back(CurvePlace(patch.centroid), static_cast<std::uint32_t>(order.size()));
  }
  std::sort(order.begin(), order.end());
  for (const auto& [place, index] : order) indices_.push_back(index);

  const std::size_t num_blocks = (patches.size() + 4 * kGroupsOfBlock - 1) / (4 * kGroupsOfBlock);
  groups_.resize(kGroupsOfBlock * num_blocks);
  areas_.resize(groups_.size());
  for (std::size_t i = 0; i < 4 * groups_.size(); ++i) {
    FourPoints& group = groups_[i / 4];
    if (i < patches.size()) {
      const Patch& patch = patches[indices_[i]];
      group.Set(i % 4, patch.centroid.cast<float>(), patch.normal.cast<float>());
      areas_[i / 4].values[i % 4] = static_cast<float>(patch.area);
    } else {
      group.Set(i % 4, Eigen::Vector3f::Constant(kNowhere), Eigen::Vector3f::Zero());
    }
  }
  balls_.resize((num_blocks + 3) / 4);
  for (FourBalls& balls : balls_) balls.radius.fill(-kNowhere);
  for (std::size_t block = 0; block < num_blocks; ++block) PlaceBall(block, patches);
}

void PatchTable::PlaceBall(std::size_t block, const std::vector<Patch>& patches) {
  const std::size_t first = 4 * kGroupsOfBlock * block;
  const std::size_t last = std::min(first + 4 * kGroupsOfBlock, indices_.size());
  Eigen::AlignedBox3d box;
  for (std::size_t i = first; i < last; ++i) box.extend(patches[indices_[i]].centroid);
  const Eigen::Vector3f centre = box.center().cast<float>();
  double radius = 0;
  for (std::size_t i = first; i < last; ++i) {
    radius = std::max(radius, (patches[indices_[i]].centroid - box.center()).norm());
  }
  FourBalls& balls = balls_[block / 4];
  const std::size_t lane = block % 4;
  balls.x[lane] = centre.x();
  balls.y[lane] = centre.y();
  balls.z[lane] = centre.z();
  balls.radius[lane] = static_cast<float>(radius) * (1 + kRounding);
}

}  // namespace semslam

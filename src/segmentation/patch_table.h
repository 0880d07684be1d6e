// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "semslam/geometry/plane.h"

#include "segmentation/lanes.h"
#include "segmentation/patches.h"

namespace semslam {

// Finds the patches near a plane: blocks of near patches are passed over as a whole, and what is
// left is looked at four at a time.
class PatchTable {
 public:
  // Costs, see PatchCost: the distance from the plane, a hundred times as much for patches whose
  // normals do not agree with it.
  struct Reach {
    double max_cost = 0;  // Metres.
    double min_normal_cosine = 0;
  };

  explicit PatchTable(const std::vector<Patch>& patches);

  // Calls visit(index), always in the same order, for all patches within reach, and for a few that
  // floats cannot tell from them.
  template <typename Visitor>
  void Visit(const Plane& plane, const Reach& reach, const Visitor& visit) const {
    const FourPlane four(plane);
    ForGroups(four, reach, [&](std::size_t group) {
      const int bits = _mm_movemask_ps(WithinReach(groups_[group], four, reach));
      if (bits == 0) return;
      for (std::size_t lane = 0; lane < 4; ++lane) {
        if ((bits >> lane & 1) != 0) visit(std::size_t{indices_[4 * group + lane]});
      }
    });
  }

  // Sum of area x exp(-cost / (2 tolerance)) over the patches, in floats. What costs more than
  // twenty tolerances is not worth its time.
  double SoftSupport(const Plane& plane, double tolerance, double min_normal_cosine) const;

 private:
  static constexpr std::size_t kGroupsOfBlock = 4;
  static constexpr float kRounding = 1e-3F;  // Share of a distance, and metres.

  // Around four blocks' centroids.
  struct FourBalls {
    alignas(16) std::array<float, 4> x{};
    alignas(16) std::array<float, 4> y{};
    alignas(16) std::array<float, 4> z{};
    alignas(16) std::array<float, 4> radius{};  // Negative enough for none to be near: no block.
  };

  struct FourAreas {
    alignas(16) std::array<float, 4> values{};
  };

  static __m128 Load(const std::array<float, 4>& row) { return _mm_load_ps(row.data()); }

  // A plane in all four lanes.
  struct FourPlane {
    explicit FourPlane(const Plane& plane)
        : normal_x(_mm_set1_ps(static_cast<float>(plane.normal.x()))),
          normal_y(_mm_set1_ps(static_cast<float>(plane.normal.y()))),
          normal_z(_mm_set1_ps(static_cast<float>(plane.normal.z()))),
          offset(_mm_set1_ps(static_cast<float>(plane.offset))) {}

    template <typename Places>
    __m128 DistanceTo(const Places& places) const {
      return Absolute(_mm_add_ps(
          Dot(Load(places.x), Load(places.y), Load(places.z), normal_x, normal_y, normal_z),
          offset));
    }
    __m128 CosineTo(const FourPoints& patches) const {
      return Absolute(Dot(Load(patches.normal_x), Load(patches.normal_y), Load(patches.normal_z),
                          normal_x, normal_y, normal_z));
    }

    __m128 normal_x;
    __m128 normal_y;
    __m128 normal_z;
    __m128 offset;
  };

  static __m128 WithinReach(const FourPoints& patches, const FourPlane& plane, const Reach& reach) {
    constexpr float kCosRounding = 1e-4F;
    constexpr float kWrongNormalFactor = 100.0F;
    const auto max_cost = static_cast<float>(reach.max_cost);
    const __m128 agrees =
        _mm_cmpge_ps(plane.CosineTo(patches),
                     _mm_set1_ps(static_cast<float>(reach.min_normal_cosine) - kCosRounding));
    const __m128 limit = Choose(agrees, _mm_set1_ps(max_cost * (1 + kRounding) + kRounding),
                                _mm_set1_ps(max_cost / kWrongNormalFactor + kRounding));
    return _mm_cmple_ps(plane.DistanceTo(patches), limit);
  }

  // Calls visit(group) for the groups of the blocks that the reach may touch.
  template <typename Visitor>
  void ForGroups(const FourPlane& plane, const Reach& reach, const Visitor& visit) const {
    const __m128 max_distance =
        _mm_set1_ps(static_cast<float>(reach.max_cost) * (1 + kRounding) + kRounding);
    for (std::size_t four = 0; four < balls_.size(); ++four) {
      const __m128 limit = _mm_add_ps(Load(balls_[four].radius), max_distance);
      const int bits = _mm_movemask_ps(_mm_cmple_ps(plane.DistanceTo(balls_[four]), limit));
      if (bits == 0) continue;
      for (std::size_t lane = 0; lane < 4; ++lane) {
        if ((bits >> lane & 1) == 0) continue;
        const std::size_t block = 4 * four + lane;
        for (std::size_t i = 0; i < kGroupsOfBlock; ++i) visit(kGroupsOfBlock * block + i);
      }
    }
  }

  void PlaceBall(std::size_t block, const std::vector<Patch>& patches);

  // Of the patches in the order of the table; near ones are near each other in it.
  std::vector<std::uint32_t> indices_;
  std::vector<FourPoints> groups_;
  std::vector<FourAreas> areas_;  // By group.
  std::vector<FourBalls> balls_;
};

}  // namespace semslam

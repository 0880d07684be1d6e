// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "semslam/geometry/plane.h"

#include "segmentation/lanes.h"
#include "segmentation/patches.h"

namespace semslam {

// Finds the patches near a plane, four at a time.
class PatchTable {
 public:
  // Costs, see PatchCost: the distance from the plane, a hundred times as much for patches whose
  // normals do not agree with it.
  struct Reach {
    double max_cost = 0;  // Metres.
    double min_normal_cosine = 0;
  };

  explicit PatchTable(const std::vector<Patch>& patches);

  // Calls visit(index) in ascending order for all patches within reach, and for a few that floats
  // cannot tell from them.
  template <typename Visitor>
  void Visit(const Plane& plane, const Reach& reach, const Visitor& visit) const {
    for (std::size_t group = 0; group < groups_.size(); ++group) {
      const int bits = WithinReach(groups_[group], plane, reach);
      if (bits == 0) continue;
      for (std::size_t lane = 0; lane < 4; ++lane) {
        if ((bits >> lane & 1) != 0) visit(4 * group + lane);
      }
    }
  }

 private:
  static int WithinReach(const FourPoints& patches, const Plane& plane, const Reach& reach) {
    constexpr float kRounding = 1e-3F;  // Share of the distance, and metres,
    constexpr float kCosRounding = 1e-4F;
    constexpr float kWrongNormalFactor = 100.0F;
    const auto splat = [](double value) { return _mm_set1_ps(static_cast<float>(value)); };
    const __m128 nx = splat(plane.normal.x());
    const __m128 ny = splat(plane.normal.y());
    const __m128 nz = splat(plane.normal.z());
    const auto load = [](const std::array<float, 4>& row) { return _mm_load_ps(row.data()); };
    const __m128 distance = Absolute(_mm_add_ps(
        Dot(load(patches.x), load(patches.y), load(patches.z), nx, ny, nz), splat(plane.offset)));
    const __m128 cosine = Absolute(
        Dot(load(patches.normal_x), load(patches.normal_y), load(patches.normal_z), nx, ny, nz));
    const auto max_cost = static_cast<float>(reach.max_cost) * (1 + kRounding) + kRounding;
    const __m128 agrees =
        _mm_cmpge_ps(cosine, splat(reach.min_normal_cosine - double{kCosRounding}));
    const __m128 limit =
        Choose(agrees, _mm_set1_ps(max_cost),
               _mm_set1_ps(static_cast<float>(reach.max_cost) / kWrongNormalFactor + kRounding));
    return _mm_movemask_ps(_mm_cmple_ps(distance, limit));
  }

  std::vector<FourPoints> groups_;
};

}  // namespace semslam

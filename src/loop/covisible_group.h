// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "semslam/map/map.h"

namespace semslam {

// All keyframes that share enough landmarks with the keyframe, most first, and itself last.
inline std::vector<KeyframeId> GroupOf(const Map& map, KeyframeId keyframe, int min_shared) {
  constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  std::vector<KeyframeId> group = map.CovisibleKeyframes(keyframe, min_shared, kAll);
  group.push_back(keyframe);
  return group;
}

}  // namespace semslam

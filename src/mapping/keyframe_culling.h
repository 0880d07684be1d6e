// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "mapping/mapping_context.h"

namespace semslam {

struct KeyframeCullingOptions {
  double close_depth_m;    // Only landmarks closer than this count.
  double redundant_ratio;  // Of them that enough others see too: the keyframe goes.
  int min_views;           // Others, at the same or a finer scale.
};

// Erases the keyframes around `center` that add nothing. Returns them, ascending. Never `center`
// nor the first keyframe.
std::vector<KeyframeId> CullRedundantKeyframes(const MappingContext& context,
                                               KeyframeId center,
                                               const KeyframeCullingOptions& options);

}  // namespace semslam

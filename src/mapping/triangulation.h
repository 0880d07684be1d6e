// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <functional>
#include <vector>

#include "mapping/mapping_context.h"

namespace semslam {

// Pairs features without landmark of the keyframe with those of its best covisible keyframes, by
// visual words and the epipolar constraint, and adds a landmark for every pair that gives a sound
// point: by parallax, or by depth where the depth camera's virtual baseline sees more parallax.
// Returns the new landmarks.
std::vector<LandmarkId> TriangulateWithNeighbours(const MappingContext& context,
                                                  KeyframeId keyframe,
                                                  std::size_t num_neighbours,
                                                  const std::function<bool()>& should_stop);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "semslam/map/map.h"

namespace semslam {

// The landmarks that a keyframe sees; none if it is gone.
std::vector<LandmarkId> LandmarksOf(const SharedMap& map, KeyframeId keyframe);

// Brings descriptor, viewing direction and distance range of landmarks in step with their
// observations and positions. Those that are gone are skipped.
void UpdateAppearances(SharedMap& map, const std::vector<LandmarkId>& landmarks);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "semslam/map/map.h"

namespace semslam {

// Brings descriptor, viewing direction and distance range of landmarks in step with their
// observations and positions. Those that are gone are skipped. Locks the map for short times only,
// and does not undo a correction of the map that comes between.
void UpdateAppearances(SharedMap& map, const std::vector<LandmarkId>& landmarks);

}  // namespace semslam

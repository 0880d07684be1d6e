// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>

#include "semslam/map/map.h"
#include "semslam/optim/bundle_adjuster.h"
#include "semslam/optim/camera_model.h"

namespace semslam {

struct FullBundleReport {
  bool finished = false;  // Neither interrupted nor overtaken, and committed.
  std::size_t num_keyframes = 0;
  std::size_t num_landmarks = 0;
  double initial_cost = 0;
  double final_cost = 0;
  double seconds = 0;
};

// Bundle adjustment of all keyframes but the first, and all landmarks (Mur-Artal, Tardos 2017,
// section III-D). Tracking and mapping may go on: it works on a copy that is taken in short pieces,
// and what came meanwhile is carried along when the result is committed. It stops without a result
// when options.should_stop says so, or the map is corrected or cleared by someone else.
FullBundleReport AdjustWholeMap(SharedMap& map,
                                const StereoCamera& camera,
                                const BundleOptions& options);

}  // namespace semslam

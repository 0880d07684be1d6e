// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <map>
#include <vector>

#include "semslam/map/map.h"
#include "semslam/optim/bundle_adjuster.h"

namespace semslam {

// A bundle adjustment's problem as it is copied out of the map, and whose its rows are.
struct BundleSnapshot {
  BundleProblem bundle;
  std::vector<KeyframeId> keyframes;      // One a pose.
  std::vector<LandmarkId> landmarks;      // One a point.
  std::vector<Observation> observations;  // One an observation.
  std::map<KeyframeId, int> pose_of;
  std::uint64_t epoch = 0;
};

void AddKeyframe(const Keyframe& keyframe, bool is_fixed, BundleSnapshot* snapshot);

enum class OtherObservers {
  kJoin,    // Keyframes that see the landmark and are not in the problem yet come in, fixed.
  kIgnore,  // Their observations are left out.
};
void AddLandmark(const Map& map,
                 LandmarkId landmark,
                 OtherObservers others,
                 BundleSnapshot* snapshot);

// Takes the observations that do not fit the solution out of the map, a few at a time, so that the
// lock is held for well below a millisecond.
void RemoveOutliers(const BundleSnapshot& snapshot,
                    const BundleSolution& solution,
                    SharedMap& shared_map);

}  // namespace semslam

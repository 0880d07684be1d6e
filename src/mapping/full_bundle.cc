// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/mapping/full_bundle.h"

#include <algorithm>
#include <span>
#include <vector>

#include "semslam/mapping/appearance_update.h"

#include "mapping/bundle_snapshot.h"

namespace semslam {
namespace {

constexpr std::size_t kNumPerLock = 512;  // Landmarks: well below a millisecond.

// Not of one moment, which does no harm: positions are where the adjustment begins, and an
// observation holds whenever it was made.
BundleSnapshot TakeSnapshot(const SharedMap& shared_map, const StereoCamera& camera) {
  BundleSnapshot snapshot;
  snapshot.bundle.camera = camera;
  const std::vector<LandmarkId> landmarks = shared_map.Read([&](const Map& map) {
    snapshot.epoch = map.epoch();
    for (const KeyframeId id : map.KeyframeIds()) {
      const Keyframe& keyframe = map.keyframe(id);
      AddKeyframe(keyframe, !keyframe.parent, &snapshot);
    }
    return map.LandmarkIds();
  });
  for (std::size_t first = 0; first < landmarks.size(); first += kNumPerLock) {
    const std::size_t last = std::min(landmarks.size(), first + kNumPerLock);
    shared_map.Read([&](const Map& map) {
      for (std::size_t i = first; i < last; ++i) {
        if (map.FindLandmark(landmarks[i]) == nullptr) continue;
        AddLandmark(map, landmarks[i], OtherObservers::kIgnore, &snapshot);
      }
    });
  }
  return snapshot;
}

bool Commit(const BundleSnapshot& snapshot, const BundleSolution& solution, Map& map) {
  if (map.epoch() != snapshot.epoch) return false;
  MapCorrection correction;
  for (std::size_t i = 0; i < snapshot.keyframes.size(); ++i) {
    const Keyframe* keyframe = map.FindKeyframe(snapshot.keyframes[i]);
    if (keyframe == nullptr) continue;
    correction.T_new_old[keyframe->id] =
        solution.T_world_camera[i] * keyframe->T_world_camera.Inverse();
  }
  correction.p_world.reserve(snapshot.landmarks.size());
  for (std::size_t i = 0; i < snapshot.landmarks.size(); ++i) {
    correction.p_world.emplace_back(snapshot.landmarks[i], solution.p_world[i]);
  }
  map.Correct(correction);
  return true;
}

}  // namespace

FullBundleReport AdjustWholeMap(SharedMap& shared_map,
                                const StereoCamera& camera,
                                const BundleOptions& options) {
  const BundleSnapshot snapshot = TakeSnapshot(shared_map, camera);
  FullBundleReport report;
  report.num_keyframes = snapshot.keyframes.size();
  report.num_landmarks = snapshot.landmarks.size();
  if (snapshot.keyframes.size() < 2) return report;

  BundleOptions interruptible = options;
  interruptible.should_stop = [&] {
    return (options.should_stop && options.should_stop()) ||
           shared_map.Read([&](const Map& map) { return map.epoch() != snapshot.epoch; });
  };
  const BundleSolution solution = AdjustBundle(snapshot.bundle, interruptible);
  report.initial_cost = solution.initial_cost;
  report.final_cost = solution.final_cost;
  report.seconds = solution.seconds;
  if (solution.stopped) return report;
  report.finished = shared_map.Write([&](Map& map) { return Commit(snapshot, solution, map); });
  if (!report.finished) return report;
  RemoveOutliers(snapshot, solution, shared_map);
  UpdateAppearances(shared_map, snapshot.landmarks);
  return report;
}

}  // namespace semslam

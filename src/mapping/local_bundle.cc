// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "mapping/local_bundle.h"

#include <algorithm>
#include <vector>

#include "semslam/mapping/appearance_update.h"

#include "mapping/bundle_snapshot.h"

namespace semslam {
namespace {

std::vector<KeyframeId> MovingKeyframes(const Map& map,
                                        KeyframeId center,
                                        const LocalBundleOptions& options) {
  std::vector<KeyframeId> moving =
      map.CovisibleKeyframes(center, options.min_shared, options.max_keyframes - 1);
  moving.push_back(center);
  std::sort(moving.begin(), moving.end());
  return moving;
}

// Keeps each lock well below a millisecond.
constexpr std::size_t kNumPerLock = 256;  // Landmarks.

// The keyframes that move, and gives the landmarks that do.
std::vector<LandmarkId> AddMovingKeyframes(const Map& map,
                                           KeyframeId center,
                                           const LocalBundleOptions& options,
                                           BundleSnapshot* snapshot) {
  if (map.FindKeyframe(center) == nullptr) return {};
  snapshot->epoch = map.epoch();
  const std::vector<KeyframeId> moving = MovingKeyframes(map, center, options);
  for (const KeyframeId id : moving) {
    const Keyframe& keyframe = map.keyframe(id);
    const bool is_origin = !keyframe.parent;
    AddKeyframe(keyframe, is_origin, snapshot);
  }
  return map.LandmarksSeenBy(moving);
}

// Not of one moment: see full_bundle.cc. If the map is moved meanwhile, the result is void anyway.
BundleSnapshot TakeSnapshot(const SharedMap& shared_map,
                            KeyframeId center,
                            const StereoCamera& camera,
                            const LocalBundleOptions& options) {
  BundleSnapshot snapshot;
  snapshot.bundle.camera = camera;
  const std::vector<LandmarkId> landmarks = shared_map.Read(
      [&](const Map& map) { return AddMovingKeyframes(map, center, options, &snapshot); });
  for (std::size_t first = 0; first < landmarks.size(); first += kNumPerLock) {
    const std::size_t last = std::min(landmarks.size(), first + kNumPerLock);
    shared_map.Read([&](const Map& map) {
      for (std::size_t i = first; i < last; ++i) {
        if (map.FindLandmark(landmarks[i]) == nullptr) continue;
        AddLandmark(map, landmarks[i], OtherObservers::kJoin, &snapshot);
      }
    });
  }
  if (snapshot.keyframes.empty()) return snapshot;
  // Something must hold the whole in place.
  auto& is_fixed = snapshot.bundle.pose_is_fixed;
  if (std::find(is_fixed.begin(), is_fixed.end(), 1) == is_fixed.end()) is_fixed.front() = 1;
  return snapshot;
}

void Commit(const BundleSnapshot& snapshot, const BundleSolution& solution, Map& map) {
  for (std::size_t i = 0; i < snapshot.keyframes.size(); ++i) {
    if (snapshot.bundle.pose_is_fixed[i] != 0) continue;
    if (map.FindKeyframe(snapshot.keyframes[i]) != nullptr) {
      map.SetPose(snapshot.keyframes[i], solution.T_world_camera[i]);
    }
  }
  for (std::size_t i = 0; i < snapshot.landmarks.size(); ++i) {
    if (map.FindLandmark(snapshot.landmarks[i]) != nullptr) {
      map.SetPosition(snapshot.landmarks[i], solution.p_world[i]);
    }
  }
}

}  // namespace

LocalBundleReport AdjustNeighbourhood(const MappingContext& context,
                                      KeyframeId keyframe,
                                      const LocalBundleOptions& options,
                                      const std::function<bool()>& should_stop) {
  const BundleSnapshot snapshot = TakeSnapshot(context.map, keyframe, context.stereo, options);
  LocalBundleReport report;
  if (snapshot.keyframes.size() < 2) return report;

  BundleOptions bundle_options = options.bundle;
  bundle_options.should_stop = should_stop;
  const BundleSolution solution = AdjustBundle(snapshot.bundle, bundle_options);
  const bool committed = context.map.Write([&](Map& map) {
    if (map.epoch() != snapshot.epoch) return false;
    Commit(snapshot, solution, map);
    return true;
  });
  report.finished = committed && !solution.stopped;
  if (!committed) return report;
  RemoveOutliers(snapshot, solution, context.map);
  UpdateAppearances(context.map, snapshot.landmarks);
  return report;
}

}  // namespace semslam

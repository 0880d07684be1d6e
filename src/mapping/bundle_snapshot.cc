// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "mapping/bundle_snapshot.h"

#include <algorithm>
#include <cstddef>

namespace semslam {
namespace {

ImagePoint ToImagePoint(const Keypoint& keypoint, const ScaleSpace& scale_space) {
  return {keypoint.pixel.cast<double>(), keypoint.right_x,
          1.0 / scale_space.PixelVariance(keypoint.octave)};
}

}  // namespace

void AddKeyframe(const Keyframe& keyframe, bool is_fixed, BundleSnapshot* snapshot) {
  snapshot->pose_of[keyframe.id] = static_cast<int>(snapshot->keyframes.size());
  snapshot->keyframes.push_back(keyframe.id);
  snapshot->bundle.T_world_camera.push_back(keyframe.T_world_camera);
  snapshot->bundle.pose_is_fixed.push_back(is_fixed ? 1 : 0);
}

void AddLandmark(const Map& map, LandmarkId id, OtherObservers others, BundleSnapshot* snapshot) {
  const Landmark& landmark = map.landmark(id);
  const auto point = static_cast<int>(snapshot->landmarks.size());
  snapshot->landmarks.push_back(id);
  snapshot->bundle.p_world.push_back(landmark.appearance.p_world);
  for (const Observation& observation : landmark.observations) {
    const Keyframe& keyframe = map.keyframe(observation.keyframe);
    if (!snapshot->pose_of.contains(keyframe.id)) {
      if (others == OtherObservers::kIgnore) continue;
      AddKeyframe(keyframe, true, snapshot);
    }
    snapshot->bundle.observations.push_back(
        {snapshot->pose_of.at(keyframe.id), point,
         ToImagePoint(keyframe.frame->keypoints[observation.feature], map.scale_space())});
    snapshot->observations.push_back(observation);
  }
}

void RemoveOutliers(const BundleSnapshot& snapshot,
                    const BundleSolution& solution,
                    SharedMap& shared_map) {
  constexpr std::size_t kNumPerLock = 64;
  std::vector<std::size_t> outliers;
  for (std::size_t i = 0; i < snapshot.observations.size(); ++i) {
    if (solution.is_inlier[i] == 0) outliers.push_back(i);
  }
  for (std::size_t first = 0; first < outliers.size(); first += kNumPerLock) {
    const std::size_t last = std::min(outliers.size(), first + kNumPerLock);
    shared_map.Write([&](Map& map) {
      for (std::size_t k = first; k < last; ++k) {
        const LandmarkId landmark =
            snapshot.landmarks[snapshot.bundle.observations[outliers[k]].point];
        const KeyframeId keyframe = snapshot.observations[outliers[k]].keyframe;
        if (map.FindLandmark(landmark) != nullptr && map.Sees(keyframe, landmark)) {
          map.RemoveObservation(landmark, keyframe);
        }
      }
    });
  }
}

}  // namespace semslam

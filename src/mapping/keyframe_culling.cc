// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "mapping/keyframe_culling.h"

#include <algorithm>

namespace semslam {
namespace {

// Whether at least min_views other keyframes see the landmark as finely (within one level) as this
// feature does.
bool IsSeenByOthers(
    const Map& map, const Landmark& landmark, KeyframeId keyframe, int octave, int min_views) {
  int num_views = 0;
  for (const Observation& other : landmark.observations) {
    if (other.keyframe == keyframe) continue;
    const Frame& frame = *map.keyframe(other.keyframe).frame;
    if (frame.keypoints[other.feature].octave <= octave + 1 && ++num_views >= min_views)
      return true;
  }
  return false;
}

bool IsRedundant(const Map& map, const Keyframe& keyframe, const KeyframeCullingOptions& options) {
  int num_close = 0;
  int num_redundant = 0;
  for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    const Keypoint& keypoint = keyframe.frame->keypoints[i];
    if (!keyframe.landmarks[i] || keypoint.depth <= 0 || keypoint.depth > options.close_depth_m)
      continue;
    ++num_close;
    const Landmark& landmark = map.landmark(*keyframe.landmarks[i]);
    if (IsSeenByOthers(map, landmark, keyframe.id, keypoint.octave, options.min_views))
      ++num_redundant;
  }
  return num_redundant > options.redundant_ratio * num_close;
}

}  // namespace

std::vector<KeyframeId> CullRedundantKeyframes(const MappingContext& context,
                                               KeyframeId center,
                                               const KeyframeCullingOptions& options) {
  std::vector<KeyframeId> candidates = context.map.Read([&](const Map& map) {
    std::vector<KeyframeId> ids;
    if (const Keyframe* keyframe = map.FindKeyframe(center)) {
      // Newer ones have not been worked into the map yet.
      for (const CovisibleKeyframe& covisible : keyframe->covisible) {
        if (covisible.id < center) ids.push_back(covisible.id);
      }
    }
    return ids;
  });
  std::vector<KeyframeId> culled;
  for (const KeyframeId id : candidates) {
    // One by one: erasing one makes the others less redundant.
    const bool is_redundant = context.map.Read([&](const Map& map) {
      const Keyframe* keyframe = map.FindKeyframe(id);
      return keyframe != nullptr && !keyframe->is_anchor() && IsRedundant(map, *keyframe, options);
    });
    if (!is_redundant) continue;
    context.map.Write([&](Map& map) {
      const Keyframe* keyframe = map.FindKeyframe(id);
      if (keyframe != nullptr && !keyframe->is_anchor()) map.EraseKeyframe(id);
    });
    culled.push_back(id);
  }
  return culled;
}

}  // namespace semslam

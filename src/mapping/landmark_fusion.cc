// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "mapping/landmark_fusion.h"

#include <algorithm>

#include "semslam/mapping/landmark_search.h"

namespace semslam {
namespace {

std::vector<KeyframeId> TargetsOf(const Map& map,
                                  KeyframeId keyframe,
                                  const FusionOptions& options) {
  std::vector<KeyframeId> targets;
  if (map.FindKeyframe(keyframe) == nullptr) return targets;
  targets = map.CovisibleKeyframes(keyframe, 1, options.num_neighbours);
  const std::size_t num_first = targets.size();
  for (std::size_t i = 0; i < num_first; ++i) {
    const std::vector<KeyframeId> second =
        map.CovisibleKeyframes(targets[i], 1, options.num_second_neighbours);
    targets.insert(targets.end(), second.begin(), second.end());
  }
  std::sort(targets.begin(), targets.end());
  targets.erase(std::unique(targets.begin(), targets.end()), targets.end());
  std::erase(targets, keyframe);
  return targets;
}

int FuseInto(const MappingContext& context,
             KeyframeId target,
             const std::vector<KeyframeId>& sources) {
  struct Copy {
    ScaleSpace scale_space;
    std::optional<KeyframeCopy> target;
    std::vector<LandmarkCopy> candidates;
  };
  const Copy copy = context.map.Read([&](const Map& map) {
    Copy c{map.scale_space(), std::nullopt, map.CopyLandmarksSeenBy(sources)};
    if (const Keyframe* keyframe = map.FindKeyframe(target)) c.target = CopyKeyframe(*keyframe);
    return c;
  });
  if (!copy.target) return 0;
  const std::vector<LandmarkHit> hits = FindLandmarks(
      {context.camera, context.stereo.bf, copy.scale_space}, *copy.target, copy.candidates, {});
  return context.map.Write([&](Map& map) { return FuseHits(target, hits, map); });
}

}  // namespace

int FuseWithNeighbours(const MappingContext& context,
                       KeyframeId keyframe,
                       const FusionOptions& options) {
  const std::vector<KeyframeId> targets =
      context.map.Read([&](const Map& map) { return TargetsOf(map, keyframe, options); });
  int num_fused = 0;
  for (const KeyframeId target : targets) num_fused += FuseInto(context, target, {keyframe});
  return num_fused + FuseInto(context, keyframe, targets);
}

}  // namespace semslam

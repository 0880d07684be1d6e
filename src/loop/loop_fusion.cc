// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "loop/loop_fusion.h"

#include "loop/covisible_group.h"

namespace semslam {

BothEnds CopyBothEnds(const Map& map, const LoopMatch& match, int min_shared) {
  BothEnds ends;
  ends.scale_space = map.scale_space();
  for (const KeyframeId id : GroupOf(map, match.keyframe, min_shared)) {
    ends.group.push_back(CopyKeyframe(map.keyframe(id)));
  }
  ends.at_the_place = map.CopyLandmarksSeenBy(GroupOf(map, match.place, min_shared));
  return ends;
}

std::vector<GroupHits> FindInGroup(const PinholeCamera& camera,
                                   double baseline_times_fx,
                                   const BothEnds& ends) {
  constexpr LandmarkSearchOptions kSearch{.radius = 4.0F, .must_agree_well = false};
  const ProjectionCamera projection{camera, baseline_times_fx, ends.scale_space};
  std::vector<GroupHits> found;
  for (const KeyframeCopy& keyframe : ends.group) {
    found.push_back({keyframe.id, FindLandmarks(projection, keyframe, ends.at_the_place, kSearch)});
  }
  return found;
}

LoopEdges EdgesToPlace(const std::vector<GroupHits>& found, const LoopMatch& match, int min_hits) {
  LoopEdges edges;
  for (const GroupHits& group : found) {
    const bool is_well_tied = static_cast<int>(group.hits.size()) >= min_hits;
    if (group.keyframe == match.keyframe || (is_well_tied && group.keyframe != match.place)) {
      edges.emplace_back(group.keyframe, match.place);
    }
  }
  return edges;
}

FusedLandmarks FuseEnds(const std::vector<GroupHits>& found, const LoopEdges& edges, Map& map) {
  for (const auto& [a, b] : edges) {
    if (map.FindKeyframe(a) != nullptr && map.FindKeyframe(b) != nullptr) map.TieByLoop(a, b);
  }
  FusedLandmarks fused;
  for (const GroupHits& group : found) {
    fused.count += FuseHits(group.keyframe, group.hits, map);
    for (const LandmarkHit& hit : group.hits) {
      if (const auto landmark = map.ResolveLandmark(hit.landmark))
        fused.touched.push_back(*landmark);
    }
  }
  return fused;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "semslam/camera/pinhole_camera.h"
#include "semslam/mapping/landmark_search.h"

#include "loop/loop_correction.h"

namespace semslam {

// Where a keyframe and a place are one, so that what both see becomes one too: common to closing a
// loop and to joining two pieces of the map.

// What is copied out of the map.
struct BothEnds {
  ScaleSpace scale_space;
  std::vector<KeyframeCopy> group;         // The keyframe and its covisible ones.
  std::vector<LandmarkCopy> at_the_place;  // Landmarks seen from the place and its covisible ones.
};
BothEnds CopyBothEnds(const Map& map, const LoopMatch& match, int min_shared);

// What a keyframe of the group shows of the landmarks at the place.
struct GroupHits {
  KeyframeId keyframe;
  std::vector<LandmarkHit> hits;
};
// The group's poses must be in the place's frame already.
std::vector<GroupHits> FindInGroup(const PinholeCamera& camera,
                                   double baseline_times_fx,
                                   const BothEnds& ends);

// The keyframe and the place, and all others of the group that show enough of it.
LoopEdges EdgesToPlace(const std::vector<GroupHits>& found, const LoopMatch& match, int min_hits);

struct FusedLandmarks {
  int count = 0;                    // Merged or seen again.
  std::vector<LandmarkId> touched;  // Their appearances are out of date.
};
// Fuses the hits and ties the edges, in the corrected map.
FusedLandmarks FuseEnds(const std::vector<GroupHits>& found, const LoopEdges& edges, Map& map);

}  // namespace semslam

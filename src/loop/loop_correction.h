// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "semslam/camera/pinhole_camera.h"
#include "semslam/map/map.h"
#include "semslam/optim/pose_graph.h"

namespace semslam {

using LoopEdges = std::vector<std::pair<KeyframeId, KeyframeId>>;

// That a keyframe shows an old place, and where it must be for that.
struct LoopMatch {
  KeyframeId keyframe;
  KeyframeId place;
  Rigid3 T_world_keyframe;
  std::uint64_t epoch = 0;  // Of the map in which this holds.
};
inline bool Holds(const LoopMatch& match, const Map& map) {
  return map.epoch() == match.epoch && map.FindKeyframe(match.keyframe) != nullptr &&
         map.FindKeyframe(match.place) != nullptr;
}

struct LoopCorrectionOptions {
  int min_shared;            // Landmarks in common: the groups around keyframe and place.
  int min_shared_essential;  // The same for an edge of the pose graph.
  int min_hits_for_edge;     // Old landmarks a keyframe must show to be tied to the place itself.
  PoseGraphOptions pose_graph;
};

struct LoopCorrection {
  int num_fused = 0;  // Landmarks that both ends see.
};

// Moves the map so that both ends of the loop meet: the keyframe's group goes where the match says,
// a pose graph spreads the difference over all keyframes, landmarks follow their reference
// keyframes, and those that both ends see become one. Nothing, and no change, if the map was
// corrected or cleared since the match, or one of the two keyframes is gone.
std::optional<LoopCorrection> CorrectLoop(const PinholeCamera& camera,
                                          double baseline_times_fx,
                                          const LoopMatch& match,
                                          const LoopCorrectionOptions& options,
                                          SharedMap& map);

// The same where keyframe and place are in two pieces of the map: the younger piece goes where the
// match says as a whole, and belongs to the older one from now on.
std::optional<LoopCorrection> JoinPieces(const PinholeCamera& camera,
                                         double baseline_times_fx,
                                         const LoopMatch& match,
                                         const LoopCorrectionOptions& options,
                                         SharedMap& map);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>

#include "semslam/base/check.h"
#include "semslam/mapping/appearance_update.h"

#include "loop/loop_correction.h"
#include "loop/loop_fusion.h"

namespace semslam {
namespace {

// Moves the younger piece; `T_place_keyframe_frame` takes the frame of the keyframe's piece to that
// of the place's.
void MoveAndJoin(const LoopMatch& match, const Rigid3& T_place_keyframe_frame, Map& map) {
  const KeyframeId piece = map.keyframe(match.keyframe).piece;
  const KeyframeId piece_of_place = map.keyframe(match.place).piece;
  const KeyframeId kept = std::min(piece, piece_of_place);
  const KeyframeId joined = std::max(piece, piece_of_place);
  const Rigid3 T_new_old =
      joined == piece ? T_place_keyframe_frame : T_place_keyframe_frame.Inverse();
  MapCorrection correction;
  for (const KeyframeId id : map.KeyframeIds()) {
    if (map.keyframe(id).piece == joined) correction.T_new_old[id] = T_new_old;
  }
  map.Correct(correction);
  map.JoinPieces(kept, joined);
}

}  // namespace

std::optional<LoopCorrection> JoinPieces(const PinholeCamera& camera,
                                         double baseline_times_fx,
                                         const LoopMatch& match,
                                         const LoopCorrectionOptions& options,
                                         SharedMap& shared_map) {
  Rigid3 T_place_keyframe_frame;
  std::optional<BothEnds> ends = shared_map.Read([&](const Map& map) -> std::optional<BothEnds> {
    if (!Holds(match, map)) return std::nullopt;
    const Keyframe& keyframe = map.keyframe(match.keyframe);
    SEMSLAM_CHECK(keyframe.piece != map.keyframe(match.place).piece);
    T_place_keyframe_frame = match.T_world_keyframe * keyframe.T_world_camera.Inverse();
    return CopyBothEnds(map, match, options.min_shared);
  });
  if (!ends) return std::nullopt;
  for (KeyframeCopy& keyframe : ends->group) {
    keyframe.T_world_camera = T_place_keyframe_frame * keyframe.T_world_camera;
  }
  const std::vector<GroupHits> found = FindInGroup(camera, baseline_times_fx, *ends);
  const LoopEdges edges = EdgesToPlace(found, match, options.min_hits_for_edge);
  const auto fused = shared_map.Write([&](Map& map) -> std::optional<FusedLandmarks> {
    if (!Holds(match, map)) return std::nullopt;
    MoveAndJoin(match, T_place_keyframe_frame, map);
    return FuseEnds(found, edges, map);
  });
  if (!fused) return std::nullopt;
  UpdateAppearances(shared_map, fused->touched);
  return LoopCorrection{.num_fused = fused->count};
}

}  // namespace semslam

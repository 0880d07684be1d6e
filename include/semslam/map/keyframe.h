// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "semslam/base/id.h"
#include "semslam/features/frame.h"
#include "semslam/geometry/rigid3.h"
#include "semslam/place/vocabulary.h"

namespace semslam {

// Another keyframe that sees some of the same landmarks.
struct CovisibleKeyframe {
  KeyframeId id;
  int num_shared = 0;  // Landmarks seen by both.
};

// A frame that the map keeps. What it saw never changes, so that is shared freely between threads.
struct Keyframe {
  KeyframeId id;
  std::shared_ptr<const Frame> frame;
  std::shared_ptr<const BagOfWords> words;  // Null until local mapping has looked the words up.
  Rigid3 T_world_camera;
  std::vector<std::optional<LandmarkId>> landmarks;  // One a feature of `frame`.
  std::optional<KeyframeId> parent;  // In the spanning tree, older; none for the first of a piece.
  std::vector<CovisibleKeyframe> covisible;  // Sorted by id.
  KeyframeId piece;  // Of the map, see Map: the id of the first keyframe of it.
  // Nothing that was seen ties it to its parent: it was the first of a piece that was joined since.
  bool starts_piece = false;
  std::vector<KeyframeId> loop_partners;  // At the other ends of loops that were closed here.

  // The map hangs together by it: it must stay.
  bool is_anchor() const { return !parent || starts_piece || !loop_partners.empty(); }
};

// A keyframe copied out of the map.
struct KeyframeCopy {
  KeyframeId id;
  std::shared_ptr<const Frame> frame;
  std::shared_ptr<const BagOfWords> words;
  Rigid3 T_world_camera;
  std::vector<std::optional<LandmarkId>> landmarks;
};
inline KeyframeCopy CopyKeyframe(const Keyframe& keyframe) {
  return {keyframe.id, keyframe.frame, keyframe.words, keyframe.T_world_camera, keyframe.landmarks};
}

}  // namespace semslam

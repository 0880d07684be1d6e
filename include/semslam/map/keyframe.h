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
  std::optional<KeyframeId> parent;          // In the spanning tree; none for the first keyframe.
  std::vector<CovisibleKeyframe> covisible;  // Sorted by id.
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

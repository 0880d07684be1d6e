// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "semslam/camera/pinhole_camera.h"
#include "semslam/map/map.h"
#include "semslam/optim/camera_model.h"

namespace semslam {

// What every step of local mapping needs.
struct MappingContext {
  const PinholeCamera& camera;
  const StereoCamera& stereo;
  SharedMap& map;
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

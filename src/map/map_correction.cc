// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/map/map.h"

namespace semslam {

// One a keyframe, by id; those that are gone have none that means anything.
std::vector<Rigid3> Map::MotionOfKeyframes(const MapCorrection& correction) const {
  std::vector<Rigid3> T_new_old(keyframes_.size());
  for (const KeyframeSlot& slot : keyframes_) {
    if (!slot.keyframe) continue;
    const Keyframe& keyframe = *slot.keyframe;
    const auto listed = correction.T_new_old.find(keyframe.id);
    if (listed != correction.T_new_old.end()) {
      T_new_old[keyframe.id.value] = listed->second;
    } else if (keyframe.parent) {
      T_new_old[keyframe.id.value] = T_new_old[keyframe.parent->value];  // Parents are older.
    }
  }
  return T_new_old;
}

void Map::Correct(const MapCorrection& correction) {
  const std::vector<Rigid3> T_new_old = MotionOfKeyframes(correction);
  for (const KeyframeSlot& slot : keyframes_) {
    if (!slot.keyframe) continue;
    Rigid3& pose = slot.keyframe->T_world_camera;
    pose = T_new_old[slot.keyframe->id.value] * pose;
  }
  for (const LandmarkSlot& slot : landmarks_) {
    if (!slot.landmark) continue;
    const Rigid3& motion = T_new_old[slot.landmark->reference_keyframe.value];
    LandmarkAppearance& appearance = slot.landmark->appearance;
    appearance.p_world = motion * appearance.p_world;
    appearance.view_direction = motion.rotation.cast<float>() * appearance.view_direction;
  }
  for (const auto& [id, p_world] : correction.p_world) {
    if (FindLandmark(id) != nullptr) SetPosition(id, p_world);
  }
  ++version_;
  ++epoch_;
}

}  // namespace semslam

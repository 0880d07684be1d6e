// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "semslam/base/id.h"
#include "semslam/map/map.h"
#include "semslam/tracking/tracked_frame.h"

namespace semslam {

// Tracking's own flat copy of the landmarks around the current frame, so that it searches them
// without the map's lock.
class LocalMap {
 public:
  // Takes the keyframes that share landmarks with the frame, their neighbours in covisibility and
  // in the spanning tree (80 at most), and copies the landmarks of all of them. The copy is skipped
  // if neither these keyframes nor the map has changed. False if the frame shares no landmark with
  // any keyframe: everything stays as it was. So it does if others hold the map for longer than
  // tracking waits and the copy is of the epoch that the frame's landmarks are of: then the copy
  // serves once more.
  bool Update(const SharedMap& map, const TrackedFrame& frame, std::uint64_t epoch_of_frame);
  // The same for those who have the map.
  bool CopyFrom(const Map& map, const TrackedFrame& frame);

  const std::vector<LandmarkCopy>& landmarks() const { return landmarks_; }  // Ascending ids.
  // The keyframe that shares most landmarks with the frame.
  KeyframeId reference_keyframe() const { return reference_; }
  const Rigid3& T_world_reference() const { return T_world_reference_; }  // When it was copied.
  // Of the map when it was copied; nothing before the first time.
  std::optional<std::uint64_t> epoch() const { return epoch_; }

 private:
  std::vector<KeyframeId> keyframes_;  // Ascending.
  std::vector<LandmarkCopy> landmarks_;
  KeyframeId reference_;
  Rigid3 T_world_reference_;
  std::uint64_t version_ = 0;
  std::optional<std::uint64_t> epoch_;
};

}  // namespace semslam

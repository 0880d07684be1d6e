// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "mapping/appearance_update.h"

#include <algorithm>
#include <utility>

namespace semslam {

std::vector<LandmarkId> LandmarksOf(const SharedMap& shared_map, KeyframeId keyframe_id) {
  return shared_map.Read([&](const Map& map) {
    std::vector<LandmarkId> ids;
    const Keyframe* keyframe = map.FindKeyframe(keyframe_id);
    if (keyframe == nullptr) return ids;
    for (const std::optional<LandmarkId> id : keyframe->landmarks) {
      if (id) ids.push_back(*id);
    }
    return ids;
  });
}

void UpdateAppearances(SharedMap& shared_map, const std::vector<LandmarkId>& landmarks) {
  constexpr std::size_t kNumPerLock = 256;  // Keeps each lock well below a millisecond.
  for (std::size_t first = 0; first < landmarks.size(); first += kNumPerLock) {
    const std::size_t last = std::min(landmarks.size(), first + kNumPerLock);
    const auto updated = shared_map.Read([&](const Map& map) {
      std::vector<std::pair<LandmarkId, LandmarkAppearance>> result;
      for (std::size_t i = first; i < last; ++i) {
        if (map.FindLandmark(landmarks[i]) == nullptr) continue;
        result.emplace_back(landmarks[i], map.ComputeAppearance(landmarks[i]));
      }
      return result;
    });
    shared_map.Write([&](Map& map) {
      for (const auto& [id, appearance] : updated) {
        if (map.FindLandmark(id) != nullptr) map.SetAppearance(id, appearance);
      }
    });
  }
}

}  // namespace semslam

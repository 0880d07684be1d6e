// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/mapping/appearance_update.h"

#include <algorithm>
#include <utility>

namespace semslam {
namespace {

struct Update {
  std::uint64_t epoch = 0;
  std::vector<std::pair<LandmarkId, LandmarkAppearance>> appearances;
};

Update ComputeUpdate(const Map& map, std::span<const LandmarkId> landmarks) {
  Update update{map.epoch(), {}};
  for (const LandmarkId id : landmarks) {
    if (map.FindLandmark(id) != nullptr) {
      update.appearances.emplace_back(id, map.ComputeAppearance(id));
    }
  }
  return update;
}

bool Commit(const Update& update, Map& map) {
  if (map.epoch() != update.epoch) return false;  // The positions in it are those of before.
  for (const auto& [id, appearance] : update.appearances) {
    if (map.FindLandmark(id) != nullptr) map.SetAppearance(id, appearance);
  }
  return true;
}

}  // namespace

void UpdateAppearances(SharedMap& shared_map, const std::vector<LandmarkId>& landmarks) {
  constexpr std::size_t kNumPerLock = 64;  // Keeps each lock well below a millisecond.
  for (std::size_t first = 0; first < landmarks.size(); first += kNumPerLock) {
    const std::size_t count = std::min(landmarks.size() - first, kNumPerLock);
    const std::span<const LandmarkId> chunk(landmarks.data() + first, count);
    bool is_done = false;
    while (!is_done) {
      const Update update =
          shared_map.Read([&](const Map& map) { return ComputeUpdate(map, chunk); });
      is_done = shared_map.Write([&](Map& map) { return Commit(update, map); });
    }
  }
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/tracking/local_map.h"

#include <algorithm>
#include <map>

#include "tracking/map_wait.h"

namespace semslam {
namespace {

constexpr std::size_t kMaxKeyframes = 80;
constexpr std::size_t kNumNeighbours = 10;  // Looked at for each keyframe, to add one.

// How many of the frame's landmarks each keyframe sees.
std::map<KeyframeId, int> CountVotes(const Map& map, const TrackedFrame& frame) {
  std::map<KeyframeId, int> votes;
  for (const std::optional<TrackedPoint>& point : frame.points) {
    if (!point || !point->landmark) continue;
    const Landmark* landmark = map.FindLandmark(*point->landmark);
    if (landmark == nullptr) continue;
    for (const Observation& observation : landmark->observations) ++votes[observation.keyframe];
  }
  return votes;
}

// Adds, for each keyframe that got votes, its best neighbour not yet among them, and its parent.
std::vector<KeyframeId> WithNeighbours(const Map& map, const std::map<KeyframeId, int>& votes) {
  std::vector<KeyframeId> chosen;
  for (const auto& [id, count] : votes) chosen.push_back(id);
  const auto contains = [&](KeyframeId id) {
    return std::find(chosen.begin(), chosen.end(), id) != chosen.end();
  };
  for (std::size_t i = 0; i < votes.size() && chosen.size() < kMaxKeyframes; ++i) {
    const KeyframeId id = chosen[i];
    for (const KeyframeId neighbour : map.CovisibleKeyframes(id, 1, kNumNeighbours)) {
      if (contains(neighbour)) continue;
      chosen.push_back(neighbour);
      break;
    }
    const std::optional<KeyframeId> parent = map.keyframe(id).parent;
    if (parent && !contains(*parent)) chosen.push_back(*parent);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace

bool LocalMap::Update(const SharedMap& shared_map,
                      const TrackedFrame& frame,
                      std::uint64_t epoch_of_frame) {
  const auto copy = [&](const Map& map) { return CopyFrom(map, frame); };
  if (epoch_ != epoch_of_frame) return shared_map.Read(copy);
  return shared_map.TryRead(kMaxMapWait, copy).value_or(true);
}

bool LocalMap::CopyFrom(const Map& map, const TrackedFrame& frame) {
  const std::map<KeyframeId, int> votes = CountVotes(map, frame);
  if (votes.empty()) return false;
  reference_ = std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) {
                 return a.second < b.second;
               })->first;
  T_world_reference_ = map.keyframe(reference_).T_world_camera;
  epoch_ = map.epoch();
  std::vector<KeyframeId> keyframes = WithNeighbours(map, votes);
  if (version_ == map.version() && keyframes == keyframes_) return true;
  landmarks_ = map.CopyLandmarksSeenBy(keyframes);
  keyframes_ = std::move(keyframes);
  version_ = map.version();
  return true;
}

}  // namespace semslam

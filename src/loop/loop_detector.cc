// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "loop/loop_detector.h"

#include <algorithm>
#include <utility>

#include "semslam/map/similar_places.h"

#include "loop/covisible_group.h"

namespace semslam {
namespace {

void SortUnique(std::vector<KeyframeId>* ids) {
  std::sort(ids->begin(), ids->end());
  ids->erase(std::unique(ids->begin(), ids->end()), ids->end());
}

std::vector<KeyframeId> SortedGroupOf(const Map& map, KeyframeId keyframe, int min_shared) {
  std::vector<KeyframeId> group = GroupOf(map, keyframe, min_shared);
  SortUnique(&group);
  return group;
}

// All that the map ties to the keyframe already: there is nothing to be closed.
std::vector<KeyframeId> Surroundings(const Map& map, KeyframeId keyframe, int min_shared) {
  std::vector<KeyframeId> around;
  for (const KeyframeId neighbour : GroupOf(map, keyframe, min_shared)) {
    const std::vector<KeyframeId> group = GroupOf(map, neighbour, min_shared);
    around.insert(around.end(), group.begin(), group.end());
  }
  for (const CovisibleKeyframe& covisible : map.keyframe(keyframe).covisible) {
    around.push_back(covisible.id);
  }
  SortUnique(&around);
  return around;
}

// How similar the next keyframes are to this one: what is less similar is no return.
float LowestScoreOfNeighbours(const Map& map, const Keyframe& keyframe, int min_shared) {
  float lowest = 1;
  for (const CovisibleKeyframe& covisible : keyframe.covisible) {
    const Keyframe& neighbour = map.keyframe(covisible.id);
    if (covisible.num_shared < min_shared || !neighbour.words) continue;
    lowest = std::min(lowest, Score(keyframe.words->vector, neighbour.words->vector));
  }
  return lowest;
}

bool Intersect(const std::vector<KeyframeId>& a, const std::vector<KeyframeId>& b) {
  return std::any_of(a.begin(), a.end(),
                     [&](KeyframeId id) { return std::binary_search(b.begin(), b.end(), id); });
}

}  // namespace

std::vector<KeyframeId> LoopDetector::FindCandidates(const Map& map, KeyframeId keyframe_id) {
  const Keyframe* keyframe = map.FindKeyframe(keyframe_id);
  if (keyframe == nullptr || !keyframe->words) return {};
  const bool is_soon =
      last_loop_ && keyframe_id.value < last_loop_->value + options_.min_keyframes_between;
  if (is_soon && map.pieces().size() == 1) return {};
  SimilarPlaceOptions search;
  search.excluded = Surroundings(map, keyframe_id, options_.min_shared);
  search.min_score = LowestScoreOfNeighbours(map, *keyframe, options_.min_shared);
  std::vector<Group> current;
  std::vector<KeyframeId> candidates;
  for (const KeyframeId place : FindSimilarPlaces(map, keyframe->words->vector, search)) {
    Group group{SortedGroupOf(map, place, options_.min_shared)};
    group.length = LengthOfChain(group.members) + 1;
    const bool is_apart = map.keyframe(place).piece != keyframe->piece;
    if (is_apart || (!is_soon && group.length >= options_.num_consistent)) {
      candidates.push_back(place);
    }
    current.push_back(std::move(group));
  }
  previous_ = std::move(current);
  return candidates;
}

void LoopDetector::LoopClosed(KeyframeId keyframe) {
  last_loop_ = keyframe;
  previous_.clear();
}

// How many keyframes before this one pointed to these, in a row.
int LoopDetector::LengthOfChain(const std::vector<KeyframeId>& members) const {
  int longest = 0;
  for (const Group& group : previous_) {
    if (group.length > longest && Intersect(members, group.members)) longest = group.length;
  }
  return longest;
}

}  // namespace semslam

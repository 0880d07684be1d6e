// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/map/similar_places.h"

#include <algorithm>
#include <map>

namespace semslam {
namespace {

// Scores of the keyframes that share enough words with the image.
std::map<KeyframeId, float> SimilarKeyframes(const Map& map,
                                             const BowVector& bow,
                                             const SimilarPlaceOptions& options) {
  std::vector<KeyframeIndex::Match> matches = map.keyframe_index().FindSimilar(bow);
  std::erase_if(matches, [&](const KeyframeIndex::Match& match) {
    return std::binary_search(options.excluded.begin(), options.excluded.end(), match.keyframe);
  });
  int most_words = 0;
  for (const KeyframeIndex::Match& match : matches) {
    most_words = std::max(most_words, match.num_shared_words);
  }
  std::map<KeyframeId, float> scores;
  for (const KeyframeIndex::Match& match : matches) {
    if (match.num_shared_words < options.min_shared_words * most_words) continue;
    if (match.score >= options.min_score) scores[match.keyframe] = match.score;
  }
  return scores;
}

// A keyframe together with its similar neighbours.
struct Group {
  float score = 0;
  KeyframeId best;  // The most similar of them.
};

Group GroupAround(const Map& map,
                  KeyframeId center,
                  const std::map<KeyframeId, float>& scores,
                  std::size_t num_neighbours) {
  Group group{scores.at(center), center};
  for (const KeyframeId neighbour : map.CovisibleKeyframes(center, 1, num_neighbours)) {
    const auto similar = scores.find(neighbour);
    if (similar == scores.end()) continue;
    group.score += similar->second;
    if (similar->second > scores.at(group.best)) group.best = neighbour;
  }
  return group;
}

}  // namespace

std::vector<KeyframeId> FindSimilarPlaces(const Map& map,
                                          const BowVector& bow,
                                          const SimilarPlaceOptions& options) {
  const std::map<KeyframeId, float> scores = SimilarKeyframes(map, bow, options);
  std::vector<Group> groups;
  for (const auto& [id, score] : scores) {
    groups.push_back(GroupAround(map, id, scores, options.num_neighbours));
  }
  std::stable_sort(groups.begin(), groups.end(),
                   [](const Group& a, const Group& b) { return a.score > b.score; });
  std::vector<KeyframeId> places;
  for (const Group& group : groups) {
    if (group.score < options.min_group_score * groups.front().score) break;
    if (std::find(places.begin(), places.end(), group.best) == places.end()) {
      places.push_back(group.best);
    }
  }
  return places;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/place/keyframe_index.h"

#include <algorithm>

#include "semslam/base/check.h"

namespace semslam {

void KeyframeIndex::Add(KeyframeId keyframe, const BowVector& bow) {
  for (const BowVector::Entry& entry : bow.entries) {
    occurrences_[entry.word].push_back({keyframe, entry.weight});
  }
  ++num_keyframes_;
}

void KeyframeIndex::Erase(KeyframeId keyframe, const BowVector& bow) {
  SEMSLAM_CHECK(num_keyframes_ > 0) << "keyframe " << keyframe.value;
  for (const BowVector::Entry& entry : bow.entries) {
    const auto word = occurrences_.find(entry.word);
    SEMSLAM_CHECK(word != occurrences_.end()) << "keyframe " << keyframe.value;
    const std::size_t num_erased = std::erase_if(
        word->second, [keyframe](const Occurrence& o) { return o.keyframe == keyframe; });
    SEMSLAM_CHECK(num_erased == 1) << "keyframe " << keyframe.value << ": " << num_erased;
    if (word->second.empty()) occurrences_.erase(word);
  }
  --num_keyframes_;
}

std::vector<KeyframeIndex::Match> KeyframeIndex::FindSimilar(const BowVector& bow) const {
  // Words in ascending order, as Score adds them up: the sums are the same to the last bit.
  std::unordered_map<KeyframeId, Match> found;
  for (const BowVector::Entry& entry : bow.entries) {
    const auto word = occurrences_.find(entry.word);
    if (word == occurrences_.end()) continue;
    for (const Occurrence& occurrence : word->second) {
      Match& match = found[occurrence.keyframe];
      ++match.num_shared_words;
      match.score += std::min(entry.weight, occurrence.weight);
    }
  }
  std::vector<Match> matches;
  matches.reserve(found.size());
  for (auto& [keyframe, match] : found) {
    match.keyframe = keyframe;
    matches.push_back(match);
  }
  std::sort(matches.begin(), matches.end(), [](const Match& a, const Match& b) {
    return a.score != b.score ? a.score > b.score : a.keyframe < b.keyframe;
  });
  return matches;
}

}  // namespace semslam

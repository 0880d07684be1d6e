// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/place/keyframe_index.h"

#include <algorithm>
#include <unordered_map>

#include "semslam/base/check.h"

namespace semslam {

void KeyframeIndex::ReserveWords(std::size_t num_words) {
  newest_.resize(std::max(newest_.size(), num_words), kNone);
}

void KeyframeIndex::Add(KeyframeId keyframe, const BowVector& bow) {
  for (const BowVector::Entry& entry : bow.entries) {
    if (entry.word >= newest_.size()) newest_.resize(std::size_t{entry.word} + 1, kNone);
    std::uint32_t& newest = newest_[entry.word];
    const Occurrence occurrence{keyframe, entry.weight, newest};
    if (free_ == kNone) {
      newest = static_cast<std::uint32_t>(occurrences_.size());
      occurrences_.push_back(occurrence);
    } else {
      newest = free_;
      free_ = occurrences_[newest].next;
      occurrences_[newest] = occurrence;
    }
  }
  ++num_keyframes_;
}

void KeyframeIndex::Erase(KeyframeId keyframe, const BowVector& bow) {
  SEMSLAM_CHECK(num_keyframes_ > 0) << "keyframe " << keyframe.value;
  for (const BowVector::Entry& entry : bow.entries) {
    SEMSLAM_CHECK(entry.word < newest_.size()) << "keyframe " << keyframe.value;
    std::uint32_t* link = &newest_[entry.word];
    while (*link != kNone && occurrences_[*link].keyframe != keyframe)
      link = &occurrences_[*link].next;
    SEMSLAM_CHECK(*link != kNone) << "keyframe " << keyframe.value;
    const std::uint32_t erased = *link;
    *link = occurrences_[erased].next;
    occurrences_[erased].next = free_;
    free_ = erased;
  }
  --num_keyframes_;
}

std::vector<KeyframeIndex::Match> KeyframeIndex::FindSimilar(const BowVector& bow) const {
  // Words in ascending order, as Score adds them up: the sums are the same to the last bit.
  std::unordered_map<KeyframeId, Match> found;
  for (const BowVector::Entry& entry : bow.entries) {
    if (entry.word >= newest_.size()) break;  // Nor are there larger ones.
    for (std::uint32_t i = newest_[entry.word]; i != kNone; i = occurrences_[i].next) {
      const Occurrence& occurrence = occurrences_[i];
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

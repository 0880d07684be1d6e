// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <vector>

#include "semslam/base/id.h"
#include "semslam/place/bag_of_words.h"

namespace semslam {

// Which keyframes show a word: finds those that look like an image without going through them all.
class KeyframeIndex {
 public:
  struct Match {
    KeyframeId keyframe;
    int num_shared_words = 0;
    float score = 0;  // As Score() of the two vectors.
  };

  // Takes the memory for so many different words now, rather than when they are added.
  void ReserveWords(std::size_t num_words);
  // A keyframe must not be added twice.
  void Add(KeyframeId keyframe, const BowVector& bow);
  // With the vector it was added with; std::logic_error if it was not.
  void Erase(KeyframeId keyframe, const BowVector& bow);
  std::size_t num_keyframes() const { return num_keyframes_; }

  // All keyframes that share a word with the image, most similar first (equals by id).
  std::vector<Match> FindSimilar(const BowVector& bow) const;

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  struct Occurrence {
    KeyframeId keyframe;
    float weight;
    std::uint32_t next;  // Of the same word, or kNone.
  };
  // A list a word. A keyframe is added under the map's lock, and shows a thousand words: lists
  // that are chained through one array grow without an allocation each.
  std::vector<std::uint32_t> newest_;  // By word: the first of its list, or kNone.
  std::deque<Occurrence> occurrences_;
  std::uint32_t free_ = kNone;  // The first of those not in use.
  std::size_t num_keyframes_ = 0;
};

}  // namespace semslam

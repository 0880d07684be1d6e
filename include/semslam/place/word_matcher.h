// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "semslam/features/projection_matcher.h"
#include "semslam/place/vocabulary.h"

namespace semslam {

// One of the two images of a word match.
struct WordMatchImage {
  const Frame& frame;
  const BagOfWords& words;
  std::span<const std::uint8_t> is_candidate;  // One a feature: nonzero takes part. Empty: all do.
};

struct WordMatchOptions {
  int max_distance = kStrictHammingLimit;  // Bits.
  float max_ratio = 0.7F;                  // Of the best distance to the second best.
  std::function<bool(int, int)>
      accept;  // Pairs to consider, by feature of the first and the second. Empty: all.
};

// Pairs features of two images that fall under the same node of the vocabulary; needs no idea of
// where the cameras are. `query` indexes the first image, `feature` the second; each feature of
// either is used once; only pairs that turn consistently are kept. Sorted by query.
std::vector<FeatureMatch> MatchByWords(const WordMatchImage& first,
                                       const WordMatchImage& second,
                                       const WordMatchOptions& options);

}  // namespace semslam

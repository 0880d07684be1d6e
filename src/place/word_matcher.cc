// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/place/word_matcher.h"

#include <utility>

#include "semslam/features/match_contest.h"

namespace semslam {
namespace {

bool IsCandidate(const WordMatchImage& image, int feature) {
  return image.is_candidate.empty() || image.is_candidate[feature] != 0;
}

class WordMatcher {
 public:
  WordMatcher(const WordMatchImage& first,
              const WordMatchImage& second,
              const WordMatchOptions& options)
      : first_(first),
        second_(second),
        options_(options),
        contest_(second.frame.keypoints.size()) {}

  // Features of both images under the same node.
  void MatchGroups(std::span<const int> first_features, std::span<const int> second_features) {
    for (const int a : first_features) {
      if (!IsCandidate(first_, a)) continue;
      int best = -1;
      int best_distance = kDescriptorBits + 1;
      int second_distance = kDescriptorBits + 1;
      for (const int b : second_features) {
        if (!IsCandidate(second_, b)) continue;
        const int distance =
            HammingDistance(first_.frame.descriptors[a], second_.frame.descriptors[b]);
        if (distance >= second_distance || (options_.accept && !options_.accept(a, b))) continue;
        if (distance < best_distance) {
          second_distance = best_distance;
          best_distance = distance;
          best = b;
        } else {
          second_distance = distance;
        }
      }
      if (best < 0 || best_distance > options_.max_distance) continue;
      if (static_cast<float>(best_distance) >
          options_.max_ratio * static_cast<float>(second_distance))
        continue;
      contest_.Enter({a, best, best_distance});
    }
  }

  std::vector<FeatureMatch> Finish() && {
    const std::vector<FeatureMatch> matches = std::move(contest_).Finish();
    std::vector<float> turns;
    for (const FeatureMatch& match : matches) {
      turns.push_back(first_.frame.keypoints[match.query].angle -
                      second_.frame.keypoints[match.feature].angle);
    }
    return KeepConsistentTurns(matches, turns);
  }

 private:
  const WordMatchImage& first_;
  const WordMatchImage& second_;
  const WordMatchOptions& options_;
  MatchContest contest_;  // For the features of the second image.
};

}  // namespace

std::vector<FeatureMatch> MatchByWords(const WordMatchImage& first,
                                       const WordMatchImage& second,
                                       const WordMatchOptions& options) {
  WordMatcher matcher(first, second, options);
  auto a = first.words.direct_index.branches.begin();
  auto b = second.words.direct_index.branches.begin();
  while (a != first.words.direct_index.branches.end() &&
         b != second.words.direct_index.branches.end()) {
    if (a->node < b->node) {
      ++a;
    } else if (b->node < a->node) {
      ++b;
    } else {
      matcher.MatchGroups(a->features, b->features);
      ++a;
      ++b;
    }
  }
  return std::move(matcher).Finish();
}

}  // namespace semslam

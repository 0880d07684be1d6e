// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "semslam/features/projection_matcher.h"

namespace semslam {

// Collects matches so that each feature has one: of two that want the same feature the nearer
// descriptor has it, the first of equals.
class MatchContest {
 public:
  explicit MatchContest(std::size_t num_features) : match_of_feature_(num_features, kNone) {}

  void Enter(const FeatureMatch& match) {
    int& holder = match_of_feature_[match.feature];
    if (holder == kNone) {
      holder = static_cast<int>(matches_.size());
      matches_.push_back(match);
    } else if (match.distance < matches_[holder].distance) {
      matches_[holder] = match;
    }
  }

  // The winners, sorted by query.
  std::vector<FeatureMatch> Finish() && {
    std::sort(matches_.begin(), matches_.end(),
              [](const FeatureMatch& a, const FeatureMatch& b) { return a.query < b.query; });
    return std::move(matches_);
  }

 private:
  static constexpr int kNone = -1;
  std::vector<int> match_of_feature_;  // Index into matches_.
  std::vector<FeatureMatch> matches_;
};

}  // namespace semslam

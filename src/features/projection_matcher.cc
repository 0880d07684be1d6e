// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/features/projection_matcher.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "semslam/features/match_contest.h"

namespace semslam {
namespace {

struct Candidate {
  int feature = -1;
  int distance = kDescriptorBits + 1;
  int octave = -1;
};

// The feature that fits best in the window, or none where it is not clearly the best.
Candidate FindBest(const ProjectedPoint& point,
                   const Frame& frame,
                   std::span<const std::uint8_t> is_taken,
                   const ProjectionMatchOptions& options) {
  Candidate best;
  Candidate second;
  frame.grid.ForEachInWindow(
      point.pixel, point.radius, point.min_octave, point.max_octave, [&](int feature) {
        if (!is_taken.empty() && is_taken[feature] != 0) return;
        const Keypoint& keypoint = frame.keypoints[feature];
        if (point.right_x != kNoRightX && keypoint.right_x != kNoRightX &&
            std::abs(point.right_x - keypoint.right_x) > point.radius) {
          return;
        }
        const int distance = HammingDistance(point.descriptor, frame.descriptors[feature]);
        if (distance < best.distance) {
          second = best;
          best = {feature, distance, keypoint.octave};
        } else if (distance < second.distance) {
          second = {feature, distance, keypoint.octave};
        }
      });
  if (best.distance > options.max_distance) return {};
  if (best.octave == second.octave &&
      static_cast<float>(best.distance) > options.max_ratio * static_cast<float>(second.distance)) {
    return {};
  }
  return best;
}

}  // namespace

std::vector<FeatureMatch> MatchProjectedPoints(std::span<const ProjectedPoint> points,
                                               const Frame& frame,
                                               std::span<const std::uint8_t> is_taken,
                                               const ProjectionMatchOptions& options) {
  MatchContest contest(frame.keypoints.size());
  for (std::size_t query = 0; query < points.size(); ++query) {
    const Candidate best = FindBest(points[query], frame, is_taken, options);
    if (best.feature < 0) continue;
    contest.Enter({static_cast<int>(query), best.feature, best.distance});
  }
  return std::move(contest).Finish();
}

std::vector<FeatureMatch> KeepConsistentTurns(const std::vector<FeatureMatch>& matches,
                                              std::span<const float> turns) {
  constexpr int kNumBins = 30;
  constexpr int kNumKept = 3;
  constexpr float kFullTurn = 2.0F * std::numbers::pi_v<float>;
  const auto bin_of = [&](std::size_t match) {
    const float fraction = turns[match] / kFullTurn;
    const int bin = static_cast<int>(std::lround((fraction - std::floor(fraction)) * kNumBins));
    return bin % kNumBins;
  };
  std::array<int, kNumBins> counts{};
  for (std::size_t i = 0; i < matches.size(); ++i) ++counts[bin_of(i)];
  std::array<int, kNumBins> order{};
  for (int i = 0; i < kNumBins; ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return counts[a] > counts[b]; });

  std::array<bool, kNumBins> keep{};
  for (int i = 0; i < kNumKept; ++i) {
    // A bin with less than a tenth of the fullest is noise.
    if (10 * counts[order[i]] >= counts[order[0]]) keep[order[i]] = true;
  }
  std::vector<FeatureMatch> kept;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (keep[bin_of(i)]) kept.push_back(matches[i]);
  }
  return kept;
}

}  // namespace semslam

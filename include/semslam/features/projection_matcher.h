// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "semslam/features/descriptor.h"
#include "semslam/features/frame.h"

namespace semslam {

// Descriptors farther apart than this do not match: in a wide search, and where the place is well
// known.
inline constexpr int kLooseHammingLimit = 100;
inline constexpr int kStrictHammingLimit = 50;

// Where a landmark should be in an image.
struct ProjectedPoint {
  Eigen::Vector2f pixel = Eigen::Vector2f::Zero();  // Ideal pixel.
  float right_x = kNoRightX;  // Column in the virtual right camera, if it is to be compared.
  float radius = 0;           // Pixels, half the side of the search window.
  int min_octave = 0;         // Inclusive.
  int max_octave = 0;         // Inclusive.
  Descriptor descriptor;
};

struct ProjectionMatchOptions {
  int max_distance = kLooseHammingLimit;  // Bits.
  // A match is refused if the second best of the same octave is nearly as good: best > ratio *
  // second. 1: never.
  float max_ratio = 1.0F;
};

// A pair of equal things: the index of a point (or of a feature of the first image) and of a
// feature.
struct FeatureMatch {
  int query = 0;
  int feature = 0;
  int distance = 0;  // Bits.
};

// The best feature of the frame for each projected point; where several points want the same
// feature, the nearest descriptor has it. Features with `is_taken[feature]` are left alone (empty:
// none is taken). Sorted by query.
std::vector<FeatureMatch> MatchProjectedPoints(std::span<const ProjectedPoint> points,
                                               const Frame& frame,
                                               std::span<const std::uint8_t> is_taken,
                                               const ProjectionMatchOptions& options);

// Between two views of one scene all features turn by about the same angle: keeps the matches whose
// turn (radians, one a match) falls into the three fullest of 30 bins.
std::vector<FeatureMatch> KeepConsistentTurns(const std::vector<FeatureMatch>& matches,
                                              std::span<const float> turns);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/eval/boundary_score.h"

#include <vector>

#include <gtest/gtest.h>

namespace semslam {
namespace {

using Numbers = std::vector<std::uint32_t>;

// A strip of 1 m x 5 cm, points 1 cm apart.
struct Strip {
  std::vector<Eigen::Vector3f> positions;

  Strip() {
    for (int i = 0; i < 100; ++i) {
      for (int j = 0; j < 5; ++j) {
        positions.emplace_back(0.01F * static_cast<float>(i), 0.01F * static_cast<float>(j), 0.0F);
      }
    }
  }
  // Number 1 before the border, 2 from there on.
  Numbers CutAt(int border_cm) const {
    Numbers numbers;
    for (const Eigen::Vector3f& p : positions) {
      numbers.push_back(p.x() < 0.01F * (static_cast<float>(border_cm) - 0.5F) ? 1 : 2);
    }
    return numbers;
  }
};

TEST(BoundaryScore, EqualBoundariesScoreOne) {
  const Strip strip;
  const BoundaryScore score = ScoreBoundaries(strip.positions, strip.CutAt(50), strip.CutAt(50));
  EXPECT_EQ(score.num_true, 10U);  // Five points on either side.
  EXPECT_DOUBLE_EQ(score.recall, 1.0);
  EXPECT_DOUBLE_EQ(score.precision, 1.0);
}

TEST(BoundaryScore, ABoundaryWithinThreeCentimetresIsFound) {
  const Strip strip;
  EXPECT_DOUBLE_EQ(ScoreBoundaries(strip.positions, strip.CutAt(52), strip.CutAt(50)).recall, 1.0);
  const BoundaryScore far = ScoreBoundaries(strip.positions, strip.CutAt(56), strip.CutAt(50));
  EXPECT_DOUBLE_EQ(far.recall, 0.0);
  EXPECT_DOUBLE_EQ(far.precision, 0.0);
}

TEST(BoundaryScore, CrumbsFindEverythingWithoutPrecision) {
  const Strip strip;
  Numbers crumbs;
  for (std::size_t i = 0; i < strip.positions.size(); ++i) {
    crumbs.push_back(static_cast<std::uint32_t>(i + 1));
  }
  const BoundaryScore score =
      ScoreBoundaries(strip.positions, crumbs, strip.CutAt(50), {.tolerance = 0.035});
  EXPECT_DOUBLE_EQ(score.recall, 1.0);
  EXPECT_DOUBLE_EQ(score.precision, 8.0 / 100.0);  // Three columns more on either side.
}

TEST(BoundaryScore, OneSegmentFindsNothing) {
  const Strip strip;
  const BoundaryScore score =
      ScoreBoundaries(strip.positions, Numbers(strip.positions.size(), 1), strip.CutAt(50));
  EXPECT_DOUBLE_EQ(score.recall, 0.0);
  EXPECT_DOUBLE_EQ(score.precision, 1.0);
}

TEST(BoundaryScore, PointsOfUnknownTruthMakeNoBoundary) {
  const Strip strip;
  Numbers truth = strip.CutAt(50);
  for (std::uint32_t& number : truth) number = number == 2 ? 0 : 1;
  const BoundaryScore score = ScoreBoundaries(strip.positions, strip.CutAt(50), truth);
  EXPECT_EQ(score.num_true, 0U);
  EXPECT_EQ(score.num_found, 0U);
  EXPECT_DOUBLE_EQ(score.recall, 1.0);
}

TEST(BoundaryScore, WhereThereIsAGapThereIsNoBoundary) {
  Strip strip;
  const Numbers numbers = strip.CutAt(50);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] == 2) strip.positions[i].z() = 0.1F;
  }
  EXPECT_EQ(ScoreBoundaries(strip.positions, numbers, numbers).num_true, 0U);
}

}  // namespace
}  // namespace semslam

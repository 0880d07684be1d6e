// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/eval/segmentation_score.h"

#include <vector>

#include <gtest/gtest.h>

namespace semslam {
namespace {

using Ids = std::vector<std::uint32_t>;

TEST(SegmentationScore, EqualPartitionsScoreOneWhateverTheirNumbers) {
  const SegmentationScore score = ScoreSegmentation(Ids{7, 7, 7, 2, 2, 9}, Ids{1, 1, 1, 2, 2, 3});
  EXPECT_DOUBLE_EQ(score.adjusted_rand_index, 1.0);
  EXPECT_DOUBLE_EQ(score.over_segmentation, 0.0);
  EXPECT_DOUBLE_EQ(score.under_segmentation, 0.0);
}

// The worked example of Hubert and Arabie's index by hand: contingency {{2,1},{0,3}}:
// pairs in both 1 + 3 = 4, in regions 3 + 3 = 6, in segments 1 + 6 = 7, all 15;
// expected 2.8, largest 6.5: (4 - 2.8) / (6.5 - 2.8).
TEST(SegmentationScore, IndexIsThatOfAnExampleByHand) {
  const SegmentationScore score = ScoreSegmentation(Ids{1, 1, 2, 2, 2, 2}, Ids{1, 1, 1, 2, 2, 2});
  EXPECT_NEAR(score.adjusted_rand_index, 1.2 / 3.7, 1e-12);
  EXPECT_NEAR(score.over_segmentation, 1.0 / 6.0, 1e-12);
  EXPECT_NEAR(score.under_segmentation, 1.0 / 6.0, 1e-12);
}

TEST(SegmentationScore, PointsOfUnknownTruthAreLeftOut) {
  const SegmentationScore score = ScoreSegmentation(Ids{1, 2, 3, 4}, Ids{1, 2, 0, 0});
  EXPECT_EQ(score.num_points, 2U);
  EXPECT_DOUBLE_EQ(score.adjusted_rand_index, 1.0);
}

TEST(SegmentationScore, UnassignedPointsCoverNoRegion) {
  const SegmentationScore score = ScoreSegmentation(Ids{1, 1, 0, 0}, Ids{1, 1, 2, 2});
  EXPECT_DOUBLE_EQ(score.over_segmentation, 0.5);
  EXPECT_DOUBLE_EQ(score.under_segmentation, 0.0);
}

TEST(SegmentationScore, NothingToCompareIsNoError) {
  EXPECT_EQ(ScoreSegmentation(Ids{}, Ids{}).num_points, 0U);
  EXPECT_EQ(ScoreSegmentation(Ids{1, 2}, Ids{0, 0}).num_points, 0U);
}

TEST(SegmentationScore, CountsWhatItCompared) {
  const SegmentationScore score = ScoreSegmentation(Ids{1, 1, 0, 3, 5}, Ids{1, 1, 2, 2, 0});
  EXPECT_EQ(score.num_points, 4U);
  EXPECT_EQ(score.num_segments, 2U);
  EXPECT_EQ(score.num_regions, 2U);
  EXPECT_DOUBLE_EQ(score.coverage, 0.75);
}

// Region 1: four points, three of them in segment 7, which has one point of region 2.
TEST(RegionScores, TellTheBestSegmentOfEachRegion) {
  const std::vector<RegionScore> scores =
      ScoreRegions(Ids{7, 7, 7, 0, 7, 0, 9}, Ids{1, 1, 1, 1, 2, 3, 0});
  ASSERT_EQ(scores.size(), 3U);
  EXPECT_EQ(scores[0].region, 1U);
  EXPECT_EQ(scores[0].num_points, 4U);
  EXPECT_EQ(scores[0].best_segment, 7U);
  EXPECT_DOUBLE_EQ(scores[0].covered, 0.75);
  EXPECT_DOUBLE_EQ(scores[0].foreign, 0.25);
  EXPECT_EQ(scores[1].best_segment, 7U);
  EXPECT_DOUBLE_EQ(scores[1].covered, 1.0);
  EXPECT_DOUBLE_EQ(scores[1].foreign, 0.75);
  EXPECT_EQ(scores[2].best_segment, 0U);
  EXPECT_DOUBLE_EQ(scores[2].covered, 0.0);
}

}  // namespace
}  // namespace semslam

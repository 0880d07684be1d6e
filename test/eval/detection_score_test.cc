// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/eval/detection_score.h"

#include <cmath>

#include <gtest/gtest.h>

namespace semslam {
namespace {

// A box of 10 x 10 pixels.
ImageBox BoxAt(float x, float y = 0) { return {x, y, x + 10, y + 10}; }

TrueBox True(float x, int class_id = 0, bool is_hard = false) {
  return {class_id, BoxAt(x), is_hard};
}

Detection Found(float x, float score, int class_id = 0) { return {class_id, score, BoxAt(x), {}}; }

double PrecisionOf(const std::vector<ScoredPicture>& pictures, int class_id = 0) {
  return ScoreDetections(pictures, 2).classes[static_cast<std::size_t>(class_id)].average_precision;
}

TEST(AveragePrecision, IsOneWhereAllIsFoundAndNothingElse) {
  EXPECT_DOUBLE_EQ(PrecisionOf({{{True(0), True(50)}, {Found(1, 0.3F), Found(50, 0.9F)}}}), 1);
}

TEST(AveragePrecision, IsTheShareFoundWhereNothingElseIs) {
  EXPECT_DOUBLE_EQ(
      PrecisionOf({{{True(0), True(50)}, {Found(0, 0.9F)}}, {{True(0), True(50)}, {}}}), 0.25);
}

TEST(AveragePrecision, OfTheAreaUnderTheFallingCurve) {
  // Right, wrong, right, right, by score: precision 1, 2/3 then 3/4, made falling: 1, 3/4, 3/4.
  const std::vector<ScoredPicture> pictures = {
      {{True(0), True(50)}, {Found(0, 0.9F), Found(50, 0.4F)}},
      {{True(0), True(50)}, {Found(100, 0.8F), Found(0, 0.5F)}}};
  EXPECT_DOUBLE_EQ(PrecisionOf(pictures), (1 + 0.75 + 0.75) / 4);
}

TEST(AveragePrecision, CountsASecondDetectionOfAnObjectAsWrong) {
  const std::vector<ScoredPicture> pictures = {
      {{True(0), True(50)}, {Found(0, 0.9F), Found(1, 0.8F), Found(50, 0.7F)}}};
  EXPECT_DOUBLE_EQ(PrecisionOf(pictures), (1 + 2.0 / 3) / 2);
}

TEST(AveragePrecision, NeedsTheOverlap) {
  // Shifted by d of 10 pixels two boxes overlap by (10 - d) / (10 + d): 0.54 for 3, 0.43 for 4.
  EXPECT_DOUBLE_EQ(PrecisionOf({{{True(0)}, {Found(3, 0.9F)}}}), 1);
  EXPECT_DOUBLE_EQ(PrecisionOf({{{True(0)}, {Found(4, 0.9F)}}}), 0);
}

TEST(AveragePrecision, TakesTheObjectThatOverlapsMost) {
  // The first detection overlaps both enough; the second only the one at 0.
  EXPECT_DOUBLE_EQ(PrecisionOf({{{True(0), True(3)}, {Found(2, 0.9F), Found(0, 0.8F)}}}), 1);
}

TEST(AveragePrecision, NeitherAsksForHardObjectsNorHoldsThemAgainstTheDetector) {
  const std::vector<ScoredPicture> pictures = {
      {{True(0), True(50, 0, true), True(80, 0, true)}, {Found(50, 0.9F), Found(0, 0.8F)}}};
  EXPECT_DOUBLE_EQ(PrecisionOf(pictures), 1);
  const DetectionScore::OfClass score = ScoreDetections(pictures, 2).classes[0];
  EXPECT_EQ(score.num_true, 1U);
  EXPECT_EQ(score.num_found, 1U);
}

TEST(AveragePrecision, KeepsClassesAndPicturesApart) {
  const std::vector<ScoredPicture> pictures = {{{True(0, 0)}, {Found(0, 0.9F, 1)}},
                                               {{True(0, 1)}, {Found(0, 0.8F, 1)}}};
  EXPECT_DOUBLE_EQ(PrecisionOf(pictures, 0), 0);
  EXPECT_DOUBLE_EQ(PrecisionOf(pictures, 1), 0.5);
  EXPECT_DOUBLE_EQ(ScoreDetections(pictures, 2).MeanAveragePrecision(), 0.25);
}

TEST(AveragePrecision, LeavesClassesWithoutObjectsOutOfTheMean) {
  const DetectionScore score = ScoreDetections(
      std::vector<ScoredPicture>{{{True(0, 0)}, {Found(0, 0.9F, 0), Found(0, 0.5F, 1)}}}, 2);
  EXPECT_TRUE(std::isnan(score.classes[1].average_precision));
  EXPECT_DOUBLE_EQ(score.MeanAveragePrecision(), 1);
}

}  // namespace
}  // namespace semslam

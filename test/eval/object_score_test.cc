// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/eval/object_score.h"

#include <cmath>

#include <gtest/gtest.h>

namespace semslam {
namespace {

// A cube of 0.2 m whose centre is at x.
ScoredObject Cube(std::uint32_t id, std::uint32_t class_number, double x) {
  ScoredObject object;
  object.id = id;
  object.class_number = class_number;
  object.box.T_world_box.translation.x() = x;
  object.box.half_size.setConstant(0.1);
  object.centroid.x() = x;
  return object;
}

using Objects = std::vector<ScoredObject>;

// Moved by a quarter of its size: intersection 3/4, union 5/4.
TEST(ObjectScore, MatchesBoxesThatOverlapEnough) {
  const Objects truth = {Cube(1, 1, 0), Cube(2, 2, 1)};
  const Objects found = {Cube(1, 1, 0.05), Cube(2, 2, 1.15)};
  const ObjectScore score = ScoreObjects(truth, found, 0.5);
  ASSERT_EQ(score.matches.size(), 1U);
  EXPECT_NEAR(score.matches[0].overlap, 0.6, 1e-9);
  EXPECT_NEAR(score.matches[0].centroid_error, 0.05, 1e-12);
  EXPECT_DOUBLE_EQ(score.Precision(), 0.5);
  EXPECT_DOUBLE_EQ(score.Recall(), 0.5);
  EXPECT_NEAR(ScoreObjects(truth, found, 0.14).MedianCentroidError(), 0.1, 1e-12);
}

TEST(ObjectScore, ASecondObjectForTheSameThingCostsPrecision) {
  const ObjectScore score =
      ScoreObjects(Objects{Cube(1, 1, 0)}, Objects{Cube(1, 1, 0.05), Cube(2, 1, 0.02)}, 0.25);
  ASSERT_EQ(score.matches.size(), 1U);
  EXPECT_EQ(score.matches[0].found_index, 1U);
  EXPECT_DOUBLE_EQ(score.Precision(), 0.5);
  EXPECT_DOUBLE_EQ(score.Recall(), 1.0);
}

TEST(ObjectScore, PrefersTheRightClassToTheBetterOverlap) {
  const ObjectScore score =
      ScoreObjects(Objects{Cube(1, 1, 0)}, Objects{Cube(1, 2, 0), Cube(2, 1, 0.05)}, 0.25);
  ASSERT_EQ(score.matches.size(), 1U);
  EXPECT_EQ(score.matches[0].found_index, 1U);
}

TEST(ObjectScore, AMatchOfAnotherClassIsNeitherPrecisionNorRecall) {
  const ObjectScore score = ScoreObjects(Objects{Cube(1, 1, 0)}, Objects{Cube(1, 2, 0)}, 0.25);
  EXPECT_EQ(score.matches.size(), 1U);
  EXPECT_DOUBLE_EQ(score.ClassAccuracy(), 0.0);
  EXPECT_DOUBLE_EQ(score.Precision(), 0.0);
  EXPECT_DOUBLE_EQ(score.Recall(), 0.0);
}

TEST(ObjectScore, WhatIsTooLittleSeenNeitherHasToBeFoundNorIsAMistake) {
  Objects truth = {Cube(1, 1, 0), Cube(2, 1, 1)};
  truth[1].counts = false;
  const ObjectScore with = ScoreObjects(truth, Objects{Cube(1, 1, 0), Cube(2, 1, 1)}, 0.25);
  EXPECT_DOUBLE_EQ(with.Precision(), 1.0);
  EXPECT_DOUBLE_EQ(with.Recall(), 1.0);
  const ObjectScore without = ScoreObjects(truth, Objects{Cube(1, 1, 0)}, 0.25);
  EXPECT_DOUBLE_EQ(without.Precision(), 1.0);
  EXPECT_DOUBLE_EQ(without.Recall(), 1.0);
}

TEST(ObjectScore, SharesOfNothingAreNotANumber) {
  const ObjectScore score = ScoreObjects(Objects{}, Objects{}, 0.25);
  EXPECT_TRUE(std::isnan(score.Precision()));
  EXPECT_TRUE(std::isnan(score.Recall()));
  EXPECT_TRUE(std::isnan(score.MedianCentroidError()));
}

}  // namespace
}  // namespace semslam

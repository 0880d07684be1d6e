// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/eval/label_score.h"

#include <cmath>

#include <gtest/gtest.h>

namespace semslam {
namespace {

using Labels = std::vector<std::uint32_t>;
using Points = std::vector<Eigen::Vector3f>;

// Class 1: three true, two found, one right. Class 2: two true, two found, both right.
TEST(LabelScore, IsThatOfAnExampleByHand) {
  const LabelScore score = ScoreLabels(Labels{1, 0, 0, 2, 2, 1, 0}, Labels{1, 1, 1, 2, 2, 0, 0}, 2);
  EXPECT_DOUBLE_EQ(score.classes[0].Precision(), 0.5);
  EXPECT_DOUBLE_EQ(score.classes[0].Recall(), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(score.classes[0].IntersectionOverUnion(), 0.25);
  EXPECT_DOUBLE_EQ(score.classes[1].IntersectionOverUnion(), 1.0);
  EXPECT_DOUBLE_EQ(score.MeanIntersectionOverUnion(), 0.625);
  EXPECT_DOUBLE_EQ(score.ObjectAccuracy(), 0.6);
  EXPECT_DOUBLE_EQ(score.Accuracy(), 4.0 / 7.0);
}

TEST(LabelScore, AClassThatIsOnlyImaginedCountsInTheMean) {
  const LabelScore score = ScoreLabels(Labels{1, 2}, Labels{1, 0}, 3);
  EXPECT_DOUBLE_EQ(score.MeanIntersectionOverUnion(), 0.5);
  EXPECT_TRUE(std::isnan(score.classes[2].IntersectionOverUnion()));
}

TEST(LabelScore, WhatIsSaidOfNothingIsWrong) {
  const LabelScore score = ScoreLabels(Labels{0, 1}, Labels{kNothingThere, kNothingThere}, 1);
  EXPECT_DOUBLE_EQ(score.Accuracy(), 0.0);
  EXPECT_EQ(score.num_object_points, 0U);
  EXPECT_DOUBLE_EQ(score.classes[0].Precision(), 0.0);
}

TEST(LabelScore, SharesOfNothingAreNotANumber) {
  const LabelScore score = ScoreLabels(Labels{}, Labels{}, 1);
  EXPECT_TRUE(std::isnan(score.Accuracy()));
  EXPECT_TRUE(std::isnan(score.MeanIntersectionOverUnion()));
}

// A row of points away from an object: 100 of them within 30 cm, every tenth with its class.
struct Row {
  Points positions;
  Labels labels;
  Labels truth;

  Row() {
    for (int i = 0; i < 200; ++i) {
      positions.emplace_back(0.0029F * static_cast<float>(i + 1), 0.0F, 0.0F);
      labels.push_back(i % 10 == 0 ? 1 : 0);
      truth.push_back(0);
    }
  }
};

TEST(Bleeding, IsTheShareOfNearPointsThatCarryTheClass) {
  Row row;
  row.positions.resize(103);  // Up to 0.2987 m.
  row.labels.resize(103);
  row.truth.resize(103);
  for (std::size_t i = 100; i < 103; ++i) row.truth[i] = 2;  // Another object: no support.
  const BleedingScore score =
      MeasureBleeding(row.positions, row.labels, row.truth, Points{{0, 0, 0}}, Labels{1});
  EXPECT_EQ(score.num_points, 100U);
  EXPECT_DOUBLE_EQ(score.Share(), 0.1);
}

TEST(Bleeding, EndsAtItsReach) {
  const Row row;
  const BleedingScore score =
      MeasureBleeding(row.positions, row.labels, row.truth, Points{{0, 0, 0}}, Labels{1}, 0.1);
  EXPECT_EQ(score.num_points, 34U);  // 34 * 2.9 mm = 98.6 mm.
  EXPECT_EQ(score.num_bleeding, 4U);
}

TEST(Bleeding, IsOnlyThatOfAClassThatIsNear) {
  Row row;
  for (std::uint32_t& label : row.labels) label = 2;
  const Points objects = {{0, 0, 0}, {5, 0, 0}};
  const BleedingScore score =
      MeasureBleeding(row.positions, row.labels, row.truth, objects, Labels{1, 2});
  EXPECT_EQ(score.num_points, 103U);
  EXPECT_EQ(score.num_bleeding, 0U);
}

TEST(Bleeding, WithoutObjectsThereIsNone) {
  const Row row;
  EXPECT_EQ(MeasureBleeding(row.positions, row.labels, row.truth, Points{}, Labels{}).num_points,
            0U);
}

}  // namespace
}  // namespace semslam

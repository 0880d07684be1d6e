// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/eval/map_evaluation.h"

#include <algorithm>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semslam/base/random.h"

#include "eval/small_scene.h"
#include "support/files.h"

namespace semslam {
namespace {

using ::testing::ElementsAre;
using testing::ExpectPerfect;
using ::testing::HasSubstr;
using testing::InputErrorOf;
using testing::PerfectResult;
using testing::SmallDesk;

constexpr std::uint32_t kKeyboard = 2;
constexpr std::uint32_t kLeftCup = 3;

std::size_t NumPoints(const ClipTruth& truth, std::uint32_t instance) {
  return static_cast<std::size_t>(
      std::count(truth.instance_of_sample.begin(), truth.instance_of_sample.end(), instance));
}

template <typename T>
void Shuffle(std::vector<T>& values, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = values.size(); i > 1; --i) {
    std::swap(values[i - 1], values[random.Index(static_cast<std::uint32_t>(i))]);
  }
}

void Move(const Rigid3& T_new_world, MapResult& result) {
  for (TimedPose& pose : result.trajectory) pose.T_world_camera = T_new_world * pose.T_world_camera;
  for (Eigen::Vector3f& p : result.positions) p = (T_new_world * p.cast<double>()).cast<float>();
  for (ObjectRecord& object : result.objects) {
    object.box.T_world_box = T_new_world * object.box.T_world_box;
    object.centroid = T_new_world * object.centroid;
  }
}

TEST(MapEvaluation, ScoresOneOnTheTruth) {
  const ClipTruth truth = SmallDesk();
  const MapEvaluation evaluation = EvaluateMap(truth, PerfectResult(truth));
  EXPECT_THAT(evaluation.classes, ElementsAre("cup", "keyboard", "mouse"));
  EXPECT_EQ(evaluation.true_objects.size(), 4U);
  ASSERT_EQ(evaluation.objects.size(), 2U);
  EXPECT_EQ(evaluation.objects[0].matches.size(), 4U);
  EXPECT_GT(evaluation.bleeding.num_points, 1000U);
  EXPECT_GT(evaluation.boundaries.num_true, 1000U);
  ExpectPerfect(evaluation);
}

// Coordinates are floats: a result some metres away is rounded to a fifth of a micrometre.
TEST(MapEvaluation, DoesNotChangeIfTheWholeResultIsMoved) {
  const ClipTruth truth = SmallDesk();
  MapResult result = PerfectResult(truth);
  Shuffle(result.labels, 1);
  const MapEvaluation before = EvaluateMap(truth, result);
  Move({ExpSO3({0.5, -1.1, 2.0}), {1.5, -2.0, 0.7}}, result);
  const MapEvaluation after = EvaluateMap(truth, result);
  constexpr double kTolerance = 1e-6;
  EXPECT_NEAR(before.surface.MedianDistance(), after.surface.MedianDistance(), kTolerance);
  EXPECT_NEAR(before.surface.completeness, after.surface.completeness, kTolerance);
  EXPECT_NEAR(before.segmentation.adjusted_rand_index, after.segmentation.adjusted_rand_index,
              kTolerance);
  EXPECT_NEAR(before.boundaries.recall, after.boundaries.recall, kTolerance);
  EXPECT_EQ(before.labels.num_right, after.labels.num_right);
  EXPECT_EQ(before.bleeding.num_bleeding, after.bleeding.num_bleeding);
  for (std::size_t i = 0; i < before.objects.size(); ++i) {
    ASSERT_EQ(before.objects[i].matches.size(), after.objects[i].matches.size());
    EXPECT_EQ(before.objects[i].Precision(), after.objects[i].Precision());
    EXPECT_NEAR(before.objects[i].matches[0].overlap, after.objects[i].matches[0].overlap, 1e-5);
  }
}

TEST(MapEvaluation, ShuffledSegmentsAgreeNoMoreThanByChance) {
  const ClipTruth truth = SmallDesk();
  MapResult result = PerfectResult(truth);
  Shuffle(result.segments, 2);
  EXPECT_NEAR(EvaluateMap(truth, result).segmentation.adjusted_rand_index, 0.0, 0.01);
}

// A share q of the points is of a class and a share q carries it, independently: by chance the
// intersection is q^2 and the union 2 q - q^2.
TEST(MapEvaluation, ShuffledLabelsOverlapNoMoreThanByChance) {
  const ClipTruth truth = SmallDesk();
  MapResult result = PerfectResult(truth);
  Shuffle(result.labels, 3);
  const MapEvaluation evaluation = EvaluateMap(truth, result);
  double chance = 0;
  for (const ClassScore& score : evaluation.labels.classes) {
    const double q =
        static_cast<double>(score.num_true) / static_cast<double>(evaluation.labels.num_points);
    chance += q / (2.0 - q) / 3.0;
  }
  EXPECT_NEAR(evaluation.labels.MeanIntersectionOverUnion(), chance, 0.01);
  EXPECT_LT(evaluation.labels.MeanIntersectionOverUnion(), 0.1);
}

// The left one of two equal cups is taken for a mouse.
TEST(MapEvaluation, OneWrongObjectCostsExactlyItsPoints) {
  const ClipTruth truth = SmallDesk();
  MapResult result = PerfectResult(truth);
  for (std::size_t i = 0; i < result.labels.size(); ++i) {
    if (truth.instance_of_sample[i] == kLeftCup) result.labels[i] = 9;
  }
  for (ObjectRecord& object : result.objects) {
    if (object.centroid.x() < -0.3) object.label = 9;
  }
  const MapEvaluation evaluation = EvaluateMap(truth, result);
  const auto cup = static_cast<double>(NumPoints(truth, kLeftCup));
  const auto keyboard = static_cast<double>(NumPoints(truth, kKeyboard));
  const auto mouse = static_cast<double>(NumPoints(truth, 5));
  const double objects = 2 * cup + keyboard + mouse;
  EXPECT_DOUBLE_EQ(evaluation.labels.ObjectAccuracy(), (objects - cup) / objects);
  EXPECT_DOUBLE_EQ(evaluation.labels.classes[0].Recall(), 0.5);
  EXPECT_DOUBLE_EQ(evaluation.labels.classes[0].Precision(), 1.0);
  EXPECT_DOUBLE_EQ(evaluation.labels.classes[2].Precision(), mouse / (mouse + cup));
  EXPECT_DOUBLE_EQ(evaluation.labels.MeanIntersectionOverUnion(),
                   (0.5 + 1.0 + mouse / (mouse + cup)) / 3.0);
  EXPECT_DOUBLE_EQ(evaluation.objects[0].Precision(), 0.75);
  EXPECT_DOUBLE_EQ(evaluation.objects[0].Recall(), 0.75);
  EXPECT_DOUBLE_EQ(evaluation.objects[0].ClassAccuracy(), 0.75);
}

TEST(MapEvaluation, SegmentOfObjectAndDeskIsForeignToTheObject) {
  const ClipTruth truth = SmallDesk();
  MapResult result = PerfectResult(truth);
  for (std::uint32_t& segment : result.segments) segment = segment == 102 ? 101 : segment;
  const MapEvaluation evaluation = EvaluateMap(truth, result);
  ASSERT_EQ(evaluation.regions[1].region, kKeyboard);
  const auto keyboard = static_cast<double>(NumPoints(truth, kKeyboard));
  const auto desk = static_cast<double>(NumPoints(truth, 1) + NumPoints(truth, 7));
  EXPECT_DOUBLE_EQ(evaluation.regions[1].covered, 1.0);
  EXPECT_NEAR(evaluation.regions[1].foreign, desk / (desk + keyboard), 1e-12);
}

TEST(MapEvaluation, PointsInTheAirAreOffTheSurfaceAndWronglyLabelled) {
  const ClipTruth truth = SmallDesk();
  MapResult result = PerfectResult(truth);
  const std::size_t num_points = result.positions.size();
  for (int i = 0; i < 100; ++i) {
    result.positions.emplace_back(0.01F * static_cast<float>(i), 0.0F, 0.5F);
    result.segments.push_back(7);
    result.labels.push_back(i < 50 ? 0 : 5);
  }
  const MapEvaluation evaluation = EvaluateMap(truth, result);
  const auto right = static_cast<double>(num_points);
  EXPECT_EQ(evaluation.surface.num_off_surface, 100U);
  EXPECT_DOUBLE_EQ(evaluation.labels.Accuracy(), right / (right + 100));
  EXPECT_EQ(evaluation.labels.classes[0].num_found, evaluation.labels.classes[0].num_true + 50);
  EXPECT_NEAR(evaluation.segmentation.adjusted_rand_index, 1.0, 1e-12);
}

TEST(MapEvaluation, EvaluatesTheClassesThatAreAskedFor) {
  const ClipTruth truth = SmallDesk();
  const MapResult result = PerfectResult(truth);
  MapEvaluationOptions options;
  options.classes = {"mug"};
  const MapEvaluation evaluation = EvaluateMap(truth, result, options);
  EXPECT_THAT(evaluation.classes, ElementsAre("mug"));
  EXPECT_EQ(evaluation.true_objects.size(), 2U);
  EXPECT_DOUBLE_EQ(evaluation.labels.ObjectAccuracy(), 1.0);
  options.classes = {"cup", "zebra"};
  EXPECT_THAT(InputErrorOf([&] { EvaluateMap(truth, result, options); }), HasSubstr("zebra"));
}

TEST(MapEvaluation, AClassThatTheDetectorDoesNotKnowIsMissed) {
  const ClipTruth truth = SmallDesk();
  MapEvaluationOptions options;
  options.classes = {"cup", "box"};
  const MapEvaluation evaluation = EvaluateMap(truth, PerfectResult(truth), options);
  EXPECT_DOUBLE_EQ(evaluation.labels.classes[1].Recall(), 0.0);
  EXPECT_DOUBLE_EQ(evaluation.labels.MeanIntersectionOverUnion(), 0.5);
  EXPECT_DOUBLE_EQ(evaluation.objects[0].Recall(), 2.0 / 3.0);
}

TEST(MapEvaluation, WithoutClassesGeometryIsStillMeasured) {
  const ClipTruth truth = SmallDesk();
  MapResult result = PerfectResult(truth);
  result.classes.clear();
  result.objects.clear();
  std::fill(result.labels.begin(), result.labels.end(), 0U);
  const MapEvaluation evaluation = EvaluateMap(truth, result);
  EXPECT_TRUE(evaluation.classes.empty());
  EXPECT_NEAR(evaluation.segmentation.adjusted_rand_index, 1.0, 1e-12);
}

TEST(MapEvaluation, AnEmptyMapIsIncompleteAndNoError) {
  const ClipTruth truth = SmallDesk();
  MapResult result;
  result.trajectory = truth.trajectory;
  const MapEvaluation evaluation = EvaluateMap(truth, result);
  EXPECT_DOUBLE_EQ(evaluation.surface.completeness, 0.0);
  EXPECT_EQ(evaluation.segmentation.num_points, 0U);
}

}  // namespace
}  // namespace semslam

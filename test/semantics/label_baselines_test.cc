// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/semantics/label_baselines.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace semslam {
namespace {

constexpr int kCup = 0;
constexpr int kBook = 1;

// A camera that looks at a wall 1 m away, of which pixel (10 i, 40) is point i.
class Wall : public ::testing::Test {
 protected:
  Wall() {
    for (int i = 0; i < 10; ++i) {
      positions_.push_back(camera_.Unproject({10.0 * i, 40.0}, 1.0).cast<float>());
    }
  }

  static PinholeCamera::Parameters Parameters() {
    PinholeCamera::Parameters parameters;
    parameters.width = 100;
    parameters.height = 80;
    parameters.fx = parameters.fy = 100;
    parameters.cx = 49.5;
    parameters.cy = 39.5;
    return parameters;
  }
  // Of points `first` to `last`.
  static Detection Box(int class_id, float score, int first, int last) {
    const auto at = [](int i) { return 10.0F * static_cast<float>(i); };
    return {class_id, score, {at(first) - 4, 20, at(last) + 4, 60}, {}};
  }
  static DetectedView View(std::vector<Detection> detections, float depth = 1.0F) {
    return {Rigid3(), cv::Mat(80, 100, CV_32FC1, cv::Scalar(depth)), std::move(detections)};
  }
  LabelBaselines Baselines(const std::vector<DetectedView>& views) const {
    LabelBaselines baselines(positions_, camera_, 2, {});
    for (const DetectedView& view : views) baselines.AddView(view);
    return baselines;
  }

  PinholeCamera camera_{Parameters()};
  std::vector<Eigen::Vector3f> positions_;
};

TEST_F(Wall, PaintingBelievesTheLastView) {
  const auto painted =
      Baselines({View({Box(kCup, 0.9F, 0, 4)}), View({Box(kBook, 0.3F, 3, 6)})}).Painted();
  EXPECT_EQ(painted, (std::vector<int>{-1, -1, -1, 1, 1, 1, 1, -1, -1, -1}));
}

TEST_F(Wall, PaintingBelievesTheLastBoxAndVotesTheBest) {
  const auto baselines = Baselines({View({Box(kCup, 0.9F, 2, 3), Box(kBook, 0.3F, 3, 4)})});
  EXPECT_EQ(baselines.Painted()[3], kBook);
  EXPECT_EQ(baselines.PointVotes()[3], kCup);
}

TEST_F(Wall, PointsGoWithMostOfTheViews) {
  const auto votes = Baselines({View({Box(kCup, 0.9F, 0, 4)}), View({Box(kBook, 0.3F, 3, 6)}),
                                View({Box(kBook, 0.3F, 4, 6)}), View({})})
                         .PointVotes();
  // Once cup and three times nothing; cup, book, twice nothing; cup, twice book, nothing; twice
  // book and twice nothing; nothing.
  EXPECT_EQ(votes, (std::vector<int>{-1, -1, -1, -1, 1, 1, 1, -1, -1, -1}));
}

TEST_F(Wall, SegmentsGoWithMostOfTheirPointsVotes) {
  const std::vector<std::uint32_t> segments = {1, 1, 1, 1, 2, 2, 2, 2, 2, 0};
  const auto votes =
      Baselines({View({Box(kCup, 0.9F, 0, 5), Box(kBook, 0.9F, 9, 9)})}).SegmentVotes(segments);
  EXPECT_EQ(votes, (std::vector<int>{0, 0, 0, 0, -1, -1, -1, -1, -1, -1}));
}

TEST_F(Wall, WhatIsHiddenOrNotMeasuredIsNotSeen) {
  const std::vector<int> nothing(positions_.size(), kNoClass);
  for (const float depth : {0.0F, 0.9F, 1.1F}) {
    const auto baselines = Baselines({View({Box(kCup, 0.9F, 0, 9)}, depth)});
    EXPECT_EQ(baselines.Painted(), nothing) << depth;
    EXPECT_EQ(baselines.PointVotes(), nothing) << depth;
  }
}

TEST_F(Wall, PointsBehindOrBesideTheCameraAreNotSeen) {
  DetectedView view = View({Box(kCup, 0.9F, 0, 9)});
  view.T_world_camera.translation = {0, 0, 2};  // The wall is 1 m behind.
  EXPECT_EQ(Baselines({view}).PointVotes(), std::vector<int>(positions_.size(), kNoClass));
  view.T_world_camera.translation = {0.45, 0, 0};  // All is 45 pixels farther left.
  const auto votes = Baselines({view}).PointVotes();
  EXPECT_EQ(votes[4], kNoClass);
  EXPECT_EQ(votes[5], kCup);
}

TEST_F(Wall, OptionsOutOfRangeAreRefused) {
  EXPECT_THROW(LabelBaselines(positions_, camera_, 2, {.max_depth_error = -1}),
               std::invalid_argument);
}

}  // namespace
}  // namespace semslam

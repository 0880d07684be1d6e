// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/loop/loop_closing.h"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semslam/mapping/full_bundle.h"

#include "loop/ring_walk.h"
#include "support/matchers.h"

namespace semslam {
namespace {

using testing::Rigid3Near;
using testing::RingWalk;
using testing::SyntheticWorld;

// Six degrees and half a metre a round.
Vector6d SomeDrift() {
  Vector6d drift;
  drift << 0.0006, 0.003, 0.0004, 0.012, 0.004, 0.008;
  return drift;
}

class LoopClosingTest : public ::testing::Test {
 protected:
  std::unique_ptr<LoopClosing> MakeLoopClosing(RingWalk& walk) {
    return std::make_unique<LoopClosing>(LoopClosing::Options{}, walk.camera(),
                                         SyntheticWorld::kBaselineTimesFx, walk.vocabulary(),
                                         walk.map());
  }
  // Walks to the end; loop closing is `lag` keyframes behind. The loops that were closed.
  std::vector<LoopClosing::Loop> ProcessAll(RingWalk& walk, int lag = 0) {
    const auto loop_closing = MakeLoopClosing(walk);
    std::vector<LoopClosing::Loop> loops;
    std::uint32_t next = 0;
    while (!walk.is_finished()) {
      const KeyframeId newest = walk.AddKeyframe();
      if (newest.value < next + lag) continue;
      if (const auto loop = loop_closing->Process({next++})) {
        loops.push_back(*loop);
        largest_when_closed_ = walk.LargestError();
        gap_when_closed_ = Gap(walk, loop->place, newest);
      }
      walk.map().Read([](const Map& map) { map.CheckConsistency(); });
    }
    return loops;
  }
  static void AddAll(RingWalk& walk) {
    while (!walk.is_finished()) walk.AddKeyframe();
  }
  // The error at the end of a walk on which no loop is closed.
  static double Drift(const RingWalk::Options& options) {
    RingWalk walk(options);
    AddAll(walk);
    return walk.LargestError();
  }
  // How far the newer keyframe is from where it truly is beside the older, metres.
  static double Gap(const RingWalk& walk, KeyframeId older, KeyframeId newer) {
    const auto a = static_cast<int>(older.value);
    const auto b = static_cast<int>(newer.value);
    const Rigid3 relative = walk.PoseOf(a).Inverse() * walk.PoseOf(b);
    const Rigid3 truth = walk.Truth(a).Inverse() * walk.Truth(b);
    return (relative.translation - truth.translation).norm();
  }
  double largest_when_closed_ = 0;
  double gap_when_closed_ = 0;
};

TEST_F(LoopClosingTest, ARoundIsClosedAndItsDriftIsGone) {
  RingWalk walk({.drift_a_step = SomeDrift()});
  const double drift = Drift({.drift_a_step = SomeDrift()});
  ASSERT_GT(drift, 0.2) << "the test drifts";
  const std::uint64_t epoch = walk.map().Read([](const Map& map) { return map.epoch(); });
  const std::vector<LoopClosing::Loop> loops = ProcessAll(walk);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_GE(loops[0].keyframe.value, 34u);
  EXPECT_LE(loops[0].place.value, 10u);
  EXPECT_GT(loops[0].num_matches, 40);
  EXPECT_GT(loops[0].num_fused, 40);
  EXPECT_GT(loops[0].distance, 0.1);
  EXPECT_LT(gap_when_closed_, 0.03) << "the ends meet";
  EXPECT_LT(largest_when_closed_, drift) << "and what is between got no worse";
  EXPECT_THAT(walk.map().Read([](const Map& map) { return *map.ResolvePose(KeyframeId{0}); }),
              Rigid3Near(Rigid3(), 0, 0))
      << "the first keyframe is the world";
  EXPECT_NE(walk.map().Read([](const Map& map) { return map.epoch(); }), epoch);
}

TEST_F(LoopClosingTest, BothEndsOfTheLoopShareLandmarksAfterwards) {
  RingWalk walk({.drift_a_step = SomeDrift()});
  const std::vector<LoopClosing::Loop> loops = ProcessAll(walk);
  ASSERT_EQ(loops.size(), 1u);
  walk.map().Read([&](const Map& map) {
    int num_shared = 0;
    for (const CovisibleKeyframe& covisible : map.keyframe(loops[0].keyframe).covisible) {
      if (covisible.id == loops[0].place) num_shared = covisible.num_shared;
    }
    EXPECT_GT(num_shared, 40);
  });
}

TEST_F(LoopClosingTest, FullBundleAdjustmentLeavesLessThanTheNoise) {
  RingWalk walk({.drift_a_step = SomeDrift(), .pixel_noise = 0.1});
  ASSERT_EQ(ProcessAll(walk).size(), 1u);
  const double before = walk.LargestError();
  const StereoCamera stereo = MakeStereoCamera(walk.camera(), SyntheticWorld::kBaselineTimesFx);
  const FullBundleReport report = AdjustWholeMap(walk.map(), stereo, {});
  EXPECT_TRUE(report.finished);
  EXPECT_EQ(report.num_keyframes, 46u);
  EXPECT_LT(report.final_cost, report.initial_cost);
  EXPECT_LT(walk.LargestError(), before);
  EXPECT_LT(walk.LargestError(), 0.02);
  walk.map().Read([](const Map& map) { map.CheckConsistency(); });
}

TEST_F(LoopClosingTest, WhatCameDuringTheCorrectionIsCarriedAlong) {
  // The newest keyframes are in the map, but loop closing has not come to them yet.
  const RingWalk::Options options{.num_keyframes = 46, .drift_a_step = SomeDrift()};
  RingWalk walk(options);
  ASSERT_EQ(ProcessAll(walk, 4).size(), 1u);
  EXPECT_LT(gap_when_closed_, Drift(options) / 4) << "also of the newest keyframe";
}

TEST_F(LoopClosingTest, WithoutAReturnThereIsNoLoop) {
  RingWalk walk({.num_keyframes = 26, .drift_a_step = SomeDrift()});
  EXPECT_TRUE(ProcessAll(walk).empty());
}

TEST_F(LoopClosingTest, APlaceThatLooksAlikeButIsBuiltDifferentlyIsNoLoop) {
  // The first keyframes get the words and descriptors of the last ones, their points stay theirs.
  RingWalk walk({.num_keyframes = 30, .drift_a_step = SomeDrift()});
  AddAll(walk);
  const auto frames = walk.map().Read([](const Map& map) {
    std::vector<KeyframeCopy> copies;
    for (const KeyframeId id : map.KeyframeIds()) copies.push_back(CopyKeyframe(map.keyframe(id)));
    return copies;
  });
  SharedMap look_alike;
  Random random(5);
  for (const KeyframeCopy& copy : frames) {
    auto frame = std::make_shared<Frame>(*copy.frame);
    const bool is_return = copy.id.value >= 24;
    if (is_return) {
      // What the first keyframes show, elsewhere in the image and at other depths.
      const Frame& first = *frames[copy.id.value - 24].frame;
      *frame = first;
      for (Keypoint& keypoint : frame->keypoints) {
        keypoint.pixel = {static_cast<float>(random.Uniform(20, 620)),
                          static_cast<float>(random.Uniform(20, 460))};
        keypoint.depth = static_cast<float>(random.Uniform(1, 4));
        keypoint.right_x = keypoint.pixel.x() - 40 / keypoint.depth;
      }
      frame->grid = FeatureGrid(frame->keypoints, walk.camera().ideal_bounds());
    }
    look_alike.Write([&](Map& map) {
      const KeyframeId id = map.AddKeyframe(frame, copy.T_world_camera);
      for (std::size_t i = 0; i < frame->keypoints.size(); i += 2) {
        const Keypoint& keypoint = frame->keypoints[i];
        map.AddLandmark(copy.T_world_camera *
                            walk.camera().Unproject(keypoint.pixel.cast<double>(), keypoint.depth),
                        {id, static_cast<int>(i)});
      }
      map.SetWords(
          id, std::make_shared<const BagOfWords>(walk.vocabulary()->Transform(frame->descriptors)));
      map.ChooseParent(id);
    });
  }
  LoopClosing loop_closing({}, walk.camera(), SyntheticWorld::kBaselineTimesFx, walk.vocabulary(),
                           look_alike);
  for (const KeyframeCopy& copy : frames) EXPECT_FALSE(loop_closing.Process(copy.id));
}

TEST_F(LoopClosingTest, PiecesOfTheMapAreJoinedOnceAKeyframeOfOneShowsAPlaceOfTheOther) {
  RingWalk walk({.lost_before = 20});
  std::size_t num_pieces_before = 0;
  while (!walk.is_finished()) {
    walk.AddKeyframe();
    num_pieces_before = std::max(num_pieces_before,
                                 walk.map().Read([](const Map& m) { return m.pieces().size(); }));
  }
  EXPECT_EQ(num_pieces_before, 2u);
  EXPECT_GT(walk.LargestError(), 0.1) << "the second piece is anywhere";
  const auto loop_closing = MakeLoopClosing(walk);
  std::vector<LoopClosing::Loop> joins;
  for (std::uint32_t i = 0; i < 46; ++i) {
    if (const auto loop = loop_closing->Process({i})) joins.push_back(*loop);
    walk.map().Read([](const Map& map) { map.CheckConsistency(); });
  }
  ASSERT_FALSE(joins.empty());
  EXPECT_TRUE(joins[0].joins_pieces);
  EXPECT_GT(joins[0].num_fused, 40);
  walk.map().Read([&](const Map& map) {
    EXPECT_EQ(map.pieces().size(), 1u);
    EXPECT_EQ(map.MainPiece(), KeyframeId{0});
    EXPECT_TRUE(map.keyframe(KeyframeId{20}).starts_piece) << "nothing was seen on the way to it";
  });
  EXPECT_LT(walk.LargestError(), 0.05);
  EXPECT_THAT(walk.PoseOf(0), Rigid3Near(Rigid3(), 0, 0)) << "the older piece stays";
}

TEST_F(LoopClosingTest, AKeyframeOfTheOlderPieceMovesTheYoungerOne) {
  // The camera goes on in the older piece, and sees what only the younger one knew.
  RingWalk walk({.num_keyframes = 40, .lost_before = 20});
  AddAll(walk);
  const Rigid3 anywhere = walk.PoseOf(30);
  const auto loop_closing = MakeLoopClosing(walk);
  // From the other side: keyframes of the first piece look for places.
  std::optional<LoopClosing::Loop> join;
  for (std::uint32_t i = 0; i < 20 && !join; ++i) join = loop_closing->Process({i});
  ASSERT_TRUE(join);
  EXPECT_TRUE(join->joins_pieces);
  EXPECT_LT(join->keyframe.value, 20u);
  EXPECT_GE(join->place.value, 20u);
  walk.map().Read([](const Map& map) { map.CheckConsistency(); });
  EXPECT_LT(walk.LargestError(), 0.05);
  EXPECT_GT((walk.PoseOf(30).translation - anywhere.translation).norm(), 0.1);
}

TEST_F(LoopClosingTest, PiecesThatHaveNothingInCommonStayApart) {
  RingWalk walk({.num_keyframes = 30, .lost_before = 19});
  AddAll(walk);
  walk.map().Write([](Map& map) {
    // As if the camera had been carried: what leads from the first places to the last is unknown.
    for (std::uint32_t i = 5; i < 19; ++i) map.SetWords({i}, nullptr);
  });
  const auto loop_closing = MakeLoopClosing(walk);
  for (std::uint32_t i = 19; i < 30; ++i) EXPECT_FALSE(loop_closing->Process({i})) << i;
  walk.map().Read([](const Map& map) { EXPECT_EQ(map.pieces().size(), 2u); });
}

TEST_F(LoopClosingTest, KeyframesThatAreGoneOrWithoutWordsArePassedOver) {
  RingWalk walk({.num_keyframes = 5});
  AddAll(walk);
  const auto loop_closing = MakeLoopClosing(walk);
  EXPECT_FALSE(loop_closing->Process(KeyframeId{999}));
  walk.map().Write([](Map& map) { map.SetWords(KeyframeId{4}, nullptr); });
  EXPECT_FALSE(loop_closing->Process(KeyframeId{4}));
}

TEST_F(LoopClosingTest, RefusesSenselessOptions) {
  RingWalk walk({.num_keyframes = 2});
  LoopClosing::Options options;
  options.num_consistent = 0;
  EXPECT_THROW(LoopClosing(options, walk.camera(), 40, walk.vocabulary(), walk.map()),
               std::logic_error);
  EXPECT_THROW(LoopClosing({}, walk.camera(), 40, nullptr, walk.map()), std::logic_error);
}

TEST_F(LoopClosingTest, GivesTheSameBitsTwice) {
  RingWalk a({.drift_a_step = SomeDrift()});
  RingWalk b({.drift_a_step = SomeDrift()});
  ProcessAll(a);
  ProcessAll(b);
  a.map().Read([&](const Map& map_a) {
    b.map().Read([&](const Map& map_b) {
      ASSERT_EQ(map_a.LandmarkIds(), map_b.LandmarkIds());
      for (const KeyframeId id : map_a.KeyframeIds()) {
        EXPECT_EQ(map_a.keyframe(id).T_world_camera.ToMatrix(),
                  map_b.keyframe(id).T_world_camera.ToMatrix());
      }
      for (const LandmarkId id : map_a.LandmarkIds()) {
        ASSERT_EQ(map_a.landmark(id).appearance.p_world, map_b.landmark(id).appearance.p_world);
      }
    });
  });
}

class FullBundleTest : public LoopClosingTest {};

TEST_F(FullBundleTest, IsStoppedWithoutATrace) {
  RingWalk walk({.num_keyframes = 12, .drift_a_step = SomeDrift()});
  AddAll(walk);
  const StereoCamera stereo = MakeStereoCamera(walk.camera(), SyntheticWorld::kBaselineTimesFx);
  const std::uint64_t version = walk.map().Read([](const Map& map) { return map.version(); });
  BundleOptions options;
  int num_asked = 0;
  options.should_stop = [&] { return ++num_asked > 2; };
  EXPECT_FALSE(AdjustWholeMap(walk.map(), stereo, options).finished);
  EXPECT_EQ(walk.map().Read([](const Map& map) { return map.version(); }), version);
}

TEST_F(FullBundleTest, GivesWayToACorrectionThatComesBetween) {
  RingWalk walk({.num_keyframes = 12, .drift_a_step = SomeDrift()});
  AddAll(walk);
  const StereoCamera stereo = MakeStereoCamera(walk.camera(), SyntheticWorld::kBaselineTimesFx);
  BundleOptions options;
  int num_asked = 0;
  options.should_stop = [&] {
    if (++num_asked == 2) walk.map().Write([](Map& map) { map.Correct({}); });
    return false;
  };
  EXPECT_FALSE(AdjustWholeMap(walk.map(), stereo, options).finished);
  EXPECT_EQ(num_asked, 2) << "it notices at once";
}

TEST_F(FullBundleTest, OfAnEmptyMapIsNothing) {
  SharedMap map;
  EXPECT_FALSE(AdjustWholeMap(map, {500, 500, 320, 240, 40}, {}).finished);
}

}  // namespace
}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/tracking/tracking.h"

#include <memory>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semslam/mapping/local_mapping.h"

#include "support/held_lock.h"
#include "support/matchers.h"
#include "support/synthetic_frames.h"

namespace semslam {
namespace {

using testing::Rigid3Near;
using testing::SyntheticView;
using testing::SyntheticWorld;

// One world and its vocabulary for all tests.
class TrackingTest : public ::testing::Test {
 protected:
  static const SyntheticWorld& World() {
    static const SyntheticWorld world(SyntheticWorld::Options{});
    return world;
  }
  static std::shared_ptr<const Vocabulary> Words() {
    static const std::shared_ptr<const Vocabulary> vocabulary = World().Train();
    return vocabulary;
  }

  Tracking::Result Track(int number) { return Track(World().LookAlongPath(number).frame); }
  Tracking::Result Track(std::shared_ptr<const Frame> frame) {
    const Tracking::Result result = tracking_->Track(std::move(frame), {});
    if (result.new_keyframe && run_mapping_)
      mapping_.Process(*result.new_keyframe, [] { return false; });
    map_.Read([](const Map& map) { map.CheckConsistency(); });
    return result;
  }
  std::size_t NumKeyframes() const {
    return map_.Read([](const Map& map) { return map.num_keyframes(); });
  }
  // A keyframe every few frames.
  static std::unique_ptr<Tracking> MakeTracking(SharedMap& map, std::size_t min_keyframes_to_keep) {
    Tracking::Options options;
    options.min_keyframes_to_keep = min_keyframes_to_keep;
    options.keyframes.changed_ratio = 0.95;
    options.keyframes.changed_ratio_at_start = 0.95;
    return std::make_unique<Tracking>(options, World().camera(), SyntheticWorld::kBaselineTimesFx,
                                      Words(), map);
  }
  void KeepEveryMap() { tracking_ = MakeTracking(map_, 0); }

  SharedMap map_;
  bool run_mapping_ = true;
  std::unique_ptr<Tracking> tracking_ = MakeTracking(map_, 5);
  LocalMapping mapping_{{}, World().camera(), SyntheticWorld::kBaselineTimesFx, Words(), map_};
};

TEST_F(TrackingTest, FollowsASmoothPathToAMillimetre) {
  int num_keyframes = 0;
  for (int i = 0; i < 90; ++i) {
    const Tracking::Result result = Track(i);
    ASSERT_EQ(result.state, TrackingState::kTracking) << "frame " << i;
    ASSERT_THAT(result.T_world_camera, Rigid3Near(SyntheticWorld::PathAt(i / 30.0), 5e-4, 1e-3))
        << "frame " << i;
    num_keyframes += result.new_keyframe ? 1 : 0;
  }
  EXPECT_GE(num_keyframes, 2) << "the first and one on the way at least";
  EXPECT_LE(num_keyframes, 30);
}

TEST_F(TrackingTest, GivesThePoseRelativeToTheReferenceKeyframeToo) {
  run_mapping_ = false;
  for (int i = 0; i < 40; ++i) {
    const Tracking::Result result = Track(i);
    const auto T_world_reference =
        map_.Read([&](const Map& map) { return map.ResolvePose(result.reference_keyframe); });
    ASSERT_TRUE(T_world_reference);
    ASSERT_THAT(*T_world_reference * result.T_reference_camera,
                Rigid3Near(result.T_world_camera, 1e-9, 1e-9));
  }
}

TEST_F(TrackingTest, SurvivesThirtyPercentWrongFeatures) {
  const SyntheticWorld wrong({.pixel_noise = 0.5, .wrong_share = 0.3});
  ASSERT_EQ(Track(0).state, TrackingState::kTracking);
  for (int i = 1; i < 60; ++i) {
    const Tracking::Result result = Track(wrong.LookAlongPath(i).frame);
    ASSERT_EQ(result.state, TrackingState::kTracking) << "frame " << i;
    ASSERT_THAT(result.T_world_camera, Rigid3Near(SyntheticWorld::PathAt(i / 30.0), 5e-3, 1e-2))
        << "frame " << i;
  }
}

TEST_F(TrackingTest, WaitsForAFrameWithEnoughFeatures) {
  EXPECT_EQ(Track(SyntheticWorld::BlankFrame(0)).state, TrackingState::kNotInitialized);
  auto few = std::make_shared<Frame>(*World().LookAlongPath(1).frame);
  few->keypoints.resize(500);
  few->descriptors.resize(500);
  EXPECT_EQ(Track(few).state, TrackingState::kNotInitialized);
  EXPECT_EQ(NumKeyframes(), 0u);
  const Tracking::Result result = Track(2);
  EXPECT_EQ(result.state, TrackingState::kTracking);
  EXPECT_TRUE(result.new_keyframe);
  EXPECT_THAT(result.T_world_camera, Rigid3Near(Rigid3(), 0, 0)) << "the first is the origin";
}

TEST_F(TrackingTest, StartsOverWhenLostForLongerThanItWasTracked) {
  for (int i = 0; i < 3; ++i) Track(i);
  for (int i = 3; i < 5; ++i) {
    const Tracking::Result blank = Track(SyntheticWorld::BlankFrame(i));
    EXPECT_EQ(blank.state, TrackingState::kLost);
    EXPECT_FALSE(blank.map_was_reset);
  }
  const Tracking::Result blank = Track(SyntheticWorld::BlankFrame(5));
  EXPECT_EQ(blank.state, TrackingState::kNotInitialized);
  EXPECT_TRUE(blank.map_was_reset);
  EXPECT_EQ(NumKeyframes(), 0u);
  const Tracking::Result again = Track(11);
  EXPECT_EQ(again.state, TrackingState::kTracking);
  EXPECT_FALSE(again.map_was_reset);
  EXPECT_THAT(again.T_world_camera, Rigid3Near(Rigid3(), 0, 0)) << "a new world";
  for (int i = 12; i < 30; ++i) {
    const Tracking::Result result = Track(i);
    ASSERT_EQ(result.state, TrackingState::kTracking) << "frame " << i;
    const Rigid3 expected =
        SyntheticWorld::PathAt(11 / 30.0).Inverse() * SyntheticWorld::PathAt(i / 30.0);
    ASSERT_THAT(result.T_world_camera, Rigid3Near(expected, 5e-4, 1e-3));
  }
}

TEST_F(TrackingTest, AFewBlankFramesDoNotCostAYoungMap) {
  for (int i = 0; i < 10; ++i) Track(i);
  for (int i = 10; i < 13; ++i) EXPECT_FALSE(Track(SyntheticWorld::BlankFrame(i)).map_was_reset);
  const Tracking::Result result = Track(13);
  EXPECT_EQ(result.state, TrackingState::kTracking);
  EXPECT_THAT(result.T_world_camera, Rigid3Near(SyntheticWorld::PathAt(13 / 30.0), 5e-4, 1e-3));
}

TEST_F(TrackingTest, AnUnexpectedViewAfterTheFirstFrameStartsANewMapAtOnce) {
  Track(0);
  const SyntheticWorld elsewhere({.seed = 99});
  const Tracking::Result result = Track(elsewhere.LookAlongPath(1).frame);
  EXPECT_TRUE(result.map_was_reset);
  EXPECT_EQ(result.state, TrackingState::kTracking) << "the same frame serves as the first";
  EXPECT_TRUE(result.new_keyframe);
  EXPECT_EQ(NumKeyframes(), 1u);
}

TEST_F(TrackingTest, LostInANewPlaceItBeginsAnotherPieceOfTheMap) {
  KeepEveryMap();
  for (int i = 0; i < 40; ++i) ASSERT_EQ(Track(i).state, TrackingState::kTracking);
  const std::size_t num_keyframes = NumKeyframes();
  const SyntheticWorld elsewhere({.seed = 99});
  int number = 40;
  for (int i = 1; i <= 5; ++i) {
    const Tracking::Result result = Track(elsewhere.LookAlongPath(number++).frame);
    EXPECT_FALSE(result.map_was_reset);
    EXPECT_EQ(result.piece_was_started, i == 5) << i;
    EXPECT_EQ(result.state, i == 5 ? TrackingState::kTracking : TrackingState::kLost);
    EXPECT_EQ(result.new_keyframe.has_value(), i == 5);
  }
  EXPECT_EQ(NumKeyframes(), num_keyframes + 1);
  for (; number < 60; ++number) {
    EXPECT_EQ(Track(elsewhere.LookAlongPath(number).frame).state, TrackingState::kTracking);
  }
  map_.Read([](const Map& map) { EXPECT_EQ(map.pieces().size(), 2u); });
  // Back in the first place it is found there.
  const Rigid3 place = SyntheticWorld::PathAt(1.0);
  const Tracking::Result back = Track(World().Look(number, place).frame);
  EXPECT_TRUE(back.relocalized);
  EXPECT_THAT(back.T_world_camera, Rigid3Near(place, 2e-3, 5e-3));
}

TEST_F(TrackingTest, AShortPieceIsDroppedAndTheLargeOneIsKept) {
  tracking_ = MakeTracking(map_, 3);
  for (int i = 0; i < 60; ++i) ASSERT_EQ(Track(i).state, TrackingState::kTracking);
  const std::size_t num_keyframes = NumKeyframes();
  ASSERT_GT(num_keyframes, 3u);
  const SyntheticWorld elsewhere({.seed = 99});
  int number = 60;
  while (number < 65) Track(elsewhere.LookAlongPath(number++).frame);
  map_.Read([](const Map& map) { ASSERT_EQ(map.pieces().size(), 2u); });
  for (int i = 0; i < 3; ++i) {
    const Tracking::Result blank = Track(SyntheticWorld::BlankFrame(number++));
    EXPECT_EQ(blank.state, TrackingState::kLost);
    EXPECT_FALSE(blank.map_was_reset);
  }
  EXPECT_EQ(NumKeyframes(), num_keyframes);
  const Tracking::Result back = Track(World().Look(number, SyntheticWorld::PathAt(1.0)).frame);
  EXPECT_EQ(back.state, TrackingState::kTracking);
}

TEST_F(TrackingTest, FindsItselfAgainWhenTheViewComesBack) {
  KeepEveryMap();
  for (int i = 0; i < 40; ++i) ASSERT_EQ(Track(i).state, TrackingState::kTracking);
  const std::size_t num_keyframes = NumKeyframes();
  for (int i = 40; i < 45; ++i) {
    const Tracking::Result result = Track(SyntheticWorld::BlankFrame(i));
    EXPECT_EQ(result.state, TrackingState::kLost);
    EXPECT_FALSE(result.map_was_reset);
    EXPECT_FALSE(result.new_keyframe);
  }
  EXPECT_EQ(NumKeyframes(), num_keyframes) << "nothing is forgotten";
  for (int i = 45; i < 90; ++i) {
    const Tracking::Result result = Track(i);
    ASSERT_EQ(result.state, TrackingState::kTracking) << "frame " << i;
    ASSERT_THAT(result.T_world_camera, Rigid3Near(SyntheticWorld::PathAt(i / 30.0), 5e-4, 1e-3));
  }
}

TEST_F(TrackingTest, IsNotFooledByAnotherPlaceWhileLost) {
  KeepEveryMap();
  for (int i = 0; i < 20; ++i) Track(i);
  const SyntheticWorld elsewhere({.seed = 99});
  for (int i = 20; i < 24; ++i) {
    EXPECT_EQ(Track(elsewhere.LookAlongPath(i).frame).state, TrackingState::kLost);
  }
  EXPECT_EQ(Track(24).state, TrackingState::kTracking);
}

TEST_F(TrackingTest, FindsItselfAgainThoughItsReferenceKeyframeWasErasedMeanwhile) {
  KeepEveryMap();
  Tracking::Result last;
  int i = 0;
  // Until it refers to a keyframe that may go: others see its landmarks too.
  for (; i < 90 && last.reference_keyframe < KeyframeId{4}; ++i) last = Track(i);
  ASSERT_GE(last.reference_keyframe, KeyframeId{4});
  EXPECT_EQ(Track(SyntheticWorld::BlankFrame(i)).state, TrackingState::kLost);
  map_.Write([&](Map& map) { map.EraseKeyframe(last.reference_keyframe); });
  EXPECT_EQ(Track(i + 1).state, TrackingState::kTracking);
}

TEST_F(TrackingTest, GoesOnWhenItsReferenceKeyframeIsErased) {
  Tracking::Result last;
  int i = 0;
  // Until it refers to a keyframe that may go: others see its landmarks too.
  for (; i < 90 && last.reference_keyframe < KeyframeId{4}; ++i) last = Track(i);
  ASSERT_GE(last.reference_keyframe, KeyframeId{4});
  map_.Write([&](Map& map) { map.EraseKeyframe(last.reference_keyframe); });
  const Tracking::Result result = Track(i);
  EXPECT_EQ(result.state, TrackingState::kTracking);
  EXPECT_FALSE(result.map_was_reset);
}

TEST_F(TrackingTest, FollowsTheMapWhenItIsMoved) {
  run_mapping_ = false;
  Tracking::Result last;
  for (int i = 0; i < 20; ++i) last = Track(i);
  const Rigid3 T_new_old{ExpSO3({0.1, -0.2, 0.3}), {1, 2, 3}};
  map_.Write([&](Map& map) {
    for (const KeyframeId id : map.KeyframeIds()) {
      map.SetPose(id, T_new_old * map.keyframe(id).T_world_camera);
    }
    for (const LandmarkId id : map.LandmarkIds()) {
      map.SetPosition(id, T_new_old * map.landmark(id).appearance.p_world);
      map.SetAppearance(id, map.ComputeAppearance(id));
    }
  });
  const Tracking::Result result = Track(20);
  ASSERT_EQ(result.state, TrackingState::kTracking);
  EXPECT_THAT(result.T_world_camera,
              Rigid3Near(T_new_old * SyntheticWorld::PathAt(20 / 30.0), 5e-4, 1e-3));
}

TEST_F(TrackingTest, FollowsTheCameraWhileAnotherThreadHoldsTheMap) {
  int i = 0;
  for (; i < 20; ++i) Track(i);
  const std::size_t num_keyframes = NumKeyframes();
  testing::HeldLock<Map> holder(map_);
  for (; i < 35; ++i) {
    const Tracking::Result result = tracking_->Track(World().LookAlongPath(i).frame, {});
    ASSERT_EQ(result.state, TrackingState::kTracking) << "frame " << i;
    EXPECT_FALSE(result.new_keyframe);
    ASSERT_THAT(result.T_world_camera, Rigid3Near(SyntheticWorld::PathAt(i / 30.0), 5e-4, 1e-3));
  }
  holder.Release();
  EXPECT_EQ(NumKeyframes(), num_keyframes);
  const Tracking::Result result = Track(i);
  EXPECT_TRUE(result.new_keyframe) << "which was due";
  EXPECT_THAT(result.T_world_camera, Rigid3Near(SyntheticWorld::PathAt(i / 30.0), 5e-4, 1e-3));
}

TEST_F(TrackingTest, TheSecondFrameNeedNotWaitForTheMapEither) {
  Track(0);
  const testing::HeldLock<Map> holder(map_);
  const Tracking::Result result = tracking_->Track(World().LookAlongPath(1).frame, {});
  ASSERT_EQ(result.state, TrackingState::kTracking);
  EXPECT_THAT(result.T_world_camera, Rigid3Near(SyntheticWorld::PathAt(1 / 30.0), 5e-4, 1e-3));
}

TEST_F(TrackingTest, HearsOfACorrectionOnceItCanHaveTheMap) {
  int i = 0;
  for (; i < 20; ++i) Track(i);
  const Rigid3 T_new_old{ExpSO3({0.1, -0.2, 0.3}), {1, 2, 3}};
  testing::HeldLock<Map> holder(map_, [&](Map& map) {
    MapCorrection correction;
    for (const KeyframeId id : map.KeyframeIds()) correction.T_new_old[id] = T_new_old;
    map.Correct(correction);
  });
  for (; i < 25; ++i) {
    ASSERT_THAT(tracking_->Track(World().LookAlongPath(i).frame, {}).T_world_camera,
                Rigid3Near(SyntheticWorld::PathAt(i / 30.0), 5e-4, 1e-3));
  }
  holder.Release();
  const Tracking::Result result = Track(i);
  ASSERT_EQ(result.state, TrackingState::kTracking);
  EXPECT_THAT(result.T_world_camera,
              Rigid3Near(T_new_old * SyntheticWorld::PathAt(i / 30.0), 5e-4, 1e-3));
}

TEST_F(TrackingTest, ANewKeyframeIsInTheMapWithItsLandmarksAndParent) {
  run_mapping_ = false;
  Tracking::Result result = Track(0);
  ASSERT_TRUE(result.new_keyframe);
  const KeyframeId first = *result.new_keyframe;
  EXPECT_EQ(map_.Read([&](const Map& map) { return map.NumTrackedLandmarks(first, 1); }),
            static_cast<int>(World().LookAlongPath(0).frame->keypoints.size()))
      << "the first keyframe makes a landmark of every feature with depth";
  result = {};
  for (int i = 1; i < 90 && !result.new_keyframe; ++i) result = Track(i);
  ASSERT_TRUE(result.new_keyframe);
  EXPECT_EQ(result.reference_keyframe, *result.new_keyframe);
  map_.Read([&](const Map& map) {
    const Keyframe& keyframe = map.keyframe(*result.new_keyframe);
    EXPECT_EQ(keyframe.parent, first);
    EXPECT_GT(map.NumTrackedLandmarks(keyframe.id, 4), 100) << "shared with the first";
    EXPECT_THAT(keyframe.T_world_camera, Rigid3Near(result.T_world_camera, 1e-12, 1e-12));
  });
}

TEST_F(TrackingTest, RefusesNoFrameAndSenselessOptions) {
  EXPECT_THROW(tracking_->Track(nullptr, {}), std::logic_error);
  Tracking::Options options;
  options.close_depth_m = 0;
  EXPECT_THROW(Tracking(options, World().camera(), 40, Words(), map_), std::logic_error);
  EXPECT_THROW(Tracking({}, World().camera(), 40, nullptr, map_), std::logic_error);
}

}  // namespace
}  // namespace semslam

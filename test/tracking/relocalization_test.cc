// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// A camera that is covered, or carried elsewhere, in a world of points.
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semslam/mapping/local_mapping.h"
#include "semslam/tracking/tracking.h"

#include "support/matchers.h"
#include "support/synthetic_frames.h"
#include "tracking/noisy_world.h"

namespace semslam {
namespace {

using testing::Rigid3Near;
using testing::SyntheticWorld;

class RelocalizationTest : public testing::NoisyWorldTest {
 protected:
  static constexpr int kNumMapped = 80;

  static Tracking::Options TrackingOptions() {
    Tracking::Options options;
    options.min_keyframes_to_keep = 2;
    options.keyframes.changed_ratio = 0.95;
    options.keyframes.changed_ratio_at_start = 0.95;
    return options;
  }

  void SetUp() override {
    for (int i = 0; i < kNumMapped; ++i) {
      ASSERT_EQ(Track(World().LookAlongPath(i).frame).state, TrackingState::kTracking);
    }
    ASSERT_GT(NumKeyframes(), 4u);
  }
  Tracking::Result Track(const std::shared_ptr<const Frame>& frame) {
    const Tracking::Result result = tracking_.Track(frame, {});
    if (result.new_keyframe) mapping_.Process(*result.new_keyframe, [] { return false; });
    return result;
  }
  // The view from where the camera was at frame `place`, as frame `number`.
  std::shared_ptr<const Frame> LookFrom(int place, int number) const {
    return World().Look(number, SyntheticWorld::PathAt(place / 30.0)).frame;
  }
  std::size_t NumKeyframes() const {
    return map_.Read([](const Map& map) { return map.num_keyframes(); });
  }

  SharedMap map_;
  Tracking tracking_{TrackingOptions(), World().camera(), SyntheticWorld::kBaselineTimesFx, Words(),
                     map_};
  LocalMapping mapping_{{}, World().camera(), SyntheticWorld::kBaselineTimesFx, Words(), map_};
};

TEST_F(RelocalizationTest, AJumpWithinTheMapIsFoundInTheSameFrame) {
  for (const int place : {10, 75, 30}) {
    const Tracking::Result result = Track(LookFrom(place, 200 + place));
    ASSERT_EQ(result.state, TrackingState::kTracking) << "place " << place;
    EXPECT_THAT(result.T_world_camera, Rigid3Near(SyntheticWorld::PathAt(place / 30.0), 3e-3, 0.03))
        << "within the noise of the map";
  }
}

TEST_F(RelocalizationTest, AfterAVeryLongCoverTheCameraIsFoundFarFromWhereItWasLost) {
  for (int i = 0; i < 60; ++i) {
    const Tracking::Result result = Track(SyntheticWorld::BlankFrame(kNumMapped + i));
    ASSERT_EQ(result.state, TrackingState::kLost);
    EXPECT_FALSE(result.relocalized);
  }
  const Tracking::Result found = Track(LookFrom(5, 200));
  ASSERT_EQ(found.state, TrackingState::kTracking);
  EXPECT_TRUE(found.relocalized);
  EXPECT_GE(found.num_inliers, 50);
  EXPECT_THAT(found.T_world_camera, Rigid3Near(SyntheticWorld::PathAt(5 / 30.0), 3e-3, 5e-3));
  EXPECT_FALSE(Track(LookFrom(6, 201)).relocalized) << "from now on it just tracks";
}

TEST_F(RelocalizationTest, TheCameraIsFoundWhereverItsReferenceIs) {
  // Only the words lead back: what is near the place of the loss is gone.
  Track(SyntheticWorld::BlankFrame(kNumMapped));
  map_.Write([](Map& map) {
    const std::vector<KeyframeId> ids = map.KeyframeIds();
    for (std::size_t i = ids.size() - 1; i >= 3; --i) map.EraseKeyframe(ids[i]);
  });
  EXPECT_TRUE(Track(LookFrom(2, 200)).relocalized);
}

TEST_F(RelocalizationTest, AnotherPlaceThatWasNeverMappedIsNotTakenForThis) {
  const SyntheticWorld elsewhere({.seed = 99});
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(Track(elsewhere.LookAlongPath(i).frame).state, TrackingState::kLost);
  }
  EXPECT_TRUE(Track(elsewhere.LookAlongPath(4).frame).piece_was_started);
}

TEST_F(RelocalizationTest, AFrameWithoutDepthIsFoundByItsPixels) {
  Track(SyntheticWorld::BlankFrame(kNumMapped));
  auto flat = std::make_shared<Frame>(*LookFrom(10, 200));
  for (Keypoint& keypoint : flat->keypoints) {
    keypoint.depth = 0;
    keypoint.right_x = kNoRightX;
  }
  const Tracking::Result found = Track(flat);
  ASSERT_EQ(found.state, TrackingState::kTracking);
  EXPECT_THAT(found.T_world_camera, Rigid3Near(SyntheticWorld::PathAt(10 / 30.0), 5e-3, 0.03));
}

TEST_F(RelocalizationTest, AFrameWithFewFeaturesIsLostWithoutHarm) {
  Track(SyntheticWorld::BlankFrame(kNumMapped));
  auto few = std::make_shared<Frame>(*LookFrom(10, 201));
  few->keypoints.resize(30);
  few->descriptors.resize(30);
  few->grid = FeatureGrid(few->keypoints, World().camera().ideal_bounds());
  EXPECT_EQ(Track(few).state, TrackingState::kLost);
  EXPECT_EQ(Track(LookFrom(10, 202)).state, TrackingState::kTracking);
}

// Most of what should be seen from there is not.
TEST_F(RelocalizationTest, APlaceThatLooksRightInOneCornerOnlyIsNotTaken) {
  auto corner = std::make_shared<Frame>(*LookFrom(0, 200));
  const std::size_t num_kept = corner->keypoints.size() / 10;
  corner->keypoints.resize(num_kept);
  corner->descriptors.resize(num_kept);
  corner->grid = FeatureGrid(corner->keypoints, World().camera().ideal_bounds());
  const BagOfWords words = Words()->Transform(corner->descriptors);
  const auto locate = [&](double min_found_share) {
    const FrameLocator locator({.min_inliers = 20, .min_found_share = min_found_share},
                               World().camera(), SyntheticWorld::kBaselineTimesFx, Words(), map_);
    return locator.Locate(corner, words, KeyframeId{0});
  };
  EXPECT_TRUE(locate(0));
  EXPECT_FALSE(locate(FrameLocator::Options().min_found_share));
}

TEST_F(RelocalizationTest, LocatorSaysNothingOfAKeyframeThatIsGone) {
  const FrameLocator locator({}, World().camera(), SyntheticWorld::kBaselineTimesFx, Words(), map_);
  const std::shared_ptr<const Frame> frame = LookFrom(0, 300);
  const BagOfWords words = Words()->Transform(frame->descriptors);
  EXPECT_TRUE(locator.Locate(frame, words, KeyframeId{0}));
  EXPECT_FALSE(locator.Locate(frame, words, KeyframeId{4000}));
}

}  // namespace
}  // namespace semslam

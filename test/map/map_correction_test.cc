// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semslam/map/map.h"

#include "map/random_frames.h"
#include "support/matchers.h"

namespace semslam {
namespace {

using testing::Rigid3Near;

// Three keyframes in a row, each with a landmark of its own; the second sees the first's too, the
// third the second's.
class MapCorrectionTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Random random(3);
    for (int i = 0; i < 3; ++i) {
      pose_[i] = testing::RandomPose(random);
      keyframe_[i] = map_.AddKeyframe(testing::RandomFrame(10, random), pose_[i]);
      landmark_[i] = map_.AddLandmark(pose_[i] * Eigen::Vector3d(0, 0, 2), {keyframe_[i], 0});
      if (i > 0) map_.AddObservation(landmark_[i - 1], {keyframe_[i], 1});
      map_.ChooseParent(keyframe_[i]);
    }
    for (int i = 0; i < 3; ++i) appearance_[i] = map_.landmark(landmark_[i]).appearance;
  }

  Map map_;
  KeyframeId keyframe_[3];
  LandmarkId landmark_[3];
  Rigid3 pose_[3];
  LandmarkAppearance appearance_[3];
  const Rigid3 motion_{ExpSO3({0.1, 0.2, -0.3}), {1, 2, 3}};
};

TEST_F(MapCorrectionTest, MovesKeyframesAndTheLandmarksThatReferToThem) {
  map_.Correct({{{keyframe_[0], Rigid3()}, {keyframe_[1], motion_}, {keyframe_[2], Rigid3()}}, {}});
  EXPECT_THAT(map_.keyframe(keyframe_[0]).T_world_camera, Rigid3Near(pose_[0], 1e-12, 1e-12));
  EXPECT_THAT(map_.keyframe(keyframe_[1]).T_world_camera,
              Rigid3Near(motion_ * pose_[1], 1e-12, 1e-12));
  const LandmarkAppearance& moved = map_.landmark(landmark_[1]).appearance;
  EXPECT_LT((moved.p_world - motion_ * appearance_[1].p_world).norm(), 1e-12);
  EXPECT_LT((moved.view_direction - motion_.rotation.cast<float>() * appearance_[1].view_direction)
                .norm(),
            1e-6F);
  EXPECT_EQ(map_.landmark(landmark_[0]).appearance.p_world, appearance_[0].p_world);
  EXPECT_EQ(map_.landmark(landmark_[2]).appearance.p_world, appearance_[2].p_world);
  map_.CheckConsistency();
}

TEST_F(MapCorrectionTest, AKeyframeThatIsNotListedFollowsItsParent) {
  ASSERT_EQ(map_.keyframe(keyframe_[2]).parent, keyframe_[1]);
  map_.Correct({{{keyframe_[0], Rigid3()}, {keyframe_[1], motion_}}, {}});
  EXPECT_THAT(map_.keyframe(keyframe_[2]).T_world_camera,
              Rigid3Near(motion_ * pose_[2], 1e-12, 1e-12));
  EXPECT_LT(
      (map_.landmark(landmark_[2]).appearance.p_world - motion_ * appearance_[2].p_world).norm(),
      1e-12);
}

TEST_F(MapCorrectionTest, AnErasedKeyframeFollowsItsParentToo) {
  map_.EraseKeyframe(keyframe_[2]);
  map_.Correct({{{keyframe_[1], motion_}, {keyframe_[2], Rigid3()}}, {}});
  EXPECT_THAT(*map_.ResolvePose(keyframe_[2]), Rigid3Near(motion_ * pose_[2], 1e-12, 1e-12));
}

TEST_F(MapCorrectionTest, ALandmarkWithAPlaceOfItsOwnTakesIt) {
  const Eigen::Vector3d place(7, 8, 9);
  const LandmarkId unknown{1000};
  map_.Correct({{{keyframe_[1], motion_}}, {{landmark_[1], place}, {unknown, place}}});
  EXPECT_EQ(map_.landmark(landmark_[1]).appearance.p_world, place);
}

TEST_F(MapCorrectionTest, BeginsANewEpoch) {
  const std::uint64_t epoch = map_.epoch();
  const std::uint64_t version = map_.version();
  map_.Correct({});
  EXPECT_NE(map_.epoch(), epoch);
  EXPECT_GT(map_.version(), version);
}

TEST_F(MapCorrectionTest, LandmarksSeenByKeyframesComeOnceAndInOrder) {
  using ::testing::ElementsAre;
  EXPECT_THAT(map_.LandmarksSeenBy(std::vector{keyframe_[2], keyframe_[1]}),
              ElementsAre(landmark_[0], landmark_[1], landmark_[2]));
  EXPECT_THAT(map_.LandmarksSeenBy(std::vector{keyframe_[0]}), ElementsAre(landmark_[0]));
  map_.EraseKeyframe(keyframe_[2]);
  EXPECT_THAT(map_.LandmarksSeenBy(std::vector{keyframe_[2], KeyframeId{99}}), ElementsAre());
}

}  // namespace
}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/map/map.h"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "map/random_frames.h"
#include "support/matchers.h"

namespace semslam {
namespace {

using ::testing::ElementsAre;
using ::testing::Optional;
using testing::RandomFrame;
using testing::RandomPose;
using testing::Rigid3Near;

class MapTest : public ::testing::Test {
 protected:
  // All features have depth.
  KeyframeId AddKeyframe(const Rigid3& pose = {}) {
    const KeyframeId id = map_.AddKeyframe(RandomFrame(100, random_, 1), pose);
    map_.ChooseParent(id);
    return id;
  }
  // `count` landmarks that all the keyframes see, at the next free features.
  std::vector<LandmarkId> Share(const std::vector<KeyframeId>& keyframes, int count) {
    std::vector<LandmarkId> ids;
    for (int i = 0; i < count; ++i) {
      const LandmarkId id = map_.AddLandmark({0, 0, 2}, {keyframes[0], next_feature_});
      for (std::size_t k = 1; k < keyframes.size(); ++k) {
        map_.AddObservation(id, {keyframes[k], next_feature_});
      }
      ++next_feature_;
      ids.push_back(id);
    }
    return ids;
  }

  Random random_{7};
  Map map_;
  int next_feature_ = 0;
};

TEST_F(MapTest, AnErasedKeyframesPoseFollowsItsParentThroughErasedParents) {
  const KeyframeId a = AddKeyframe(RandomPose(random_));
  const KeyframeId b = AddKeyframe(RandomPose(random_));
  const KeyframeId c = AddKeyframe(RandomPose(random_));
  Share({a, b}, 3);
  Share({b, c}, 3);
  map_.ChooseParent(b);
  map_.ChooseParent(c);
  ASSERT_EQ(map_.keyframe(c).parent, b);
  const Rigid3 T_a_c = map_.keyframe(a).T_world_camera.Inverse() * map_.keyframe(c).T_world_camera;
  map_.EraseKeyframe(c);
  map_.EraseKeyframe(b);
  const Rigid3 T_world_a = RandomPose(random_);
  map_.SetPose(a, T_world_a);
  EXPECT_THAT(map_.ResolvePose(c), Optional(Rigid3Near(T_world_a * T_a_c, 1e-9, 1e-9)));
}

TEST_F(MapTest, ALandmarkResolvesThroughAChainOfMerges) {
  const KeyframeId a = AddKeyframe();
  const std::vector<LandmarkId> ids = Share({a}, 4);
  map_.MergeLandmarks(ids[1], ids[0]);
  map_.MergeLandmarks(ids[2], ids[1]);
  EXPECT_EQ(map_.ResolveLandmark(ids[0]), ids[2]);
  map_.EraseLandmark(ids[2]);
  EXPECT_EQ(map_.ResolveLandmark(ids[0]), std::nullopt);
  EXPECT_EQ(map_.ResolveLandmark(ids[3]), ids[3]);
  EXPECT_EQ(map_.ResolveLandmark(LandmarkId{99}), std::nullopt);
}

TEST_F(MapTest, MergingKeepsOneObservationAKeyframeAndAddsSightings) {
  const KeyframeId a = AddKeyframe();
  const KeyframeId b = AddKeyframe();
  const LandmarkId keep = Share({a}, 1).front();
  const LandmarkId drop = Share({a, b}, 1).front();
  map_.CountSightings(drop, 9, 4);
  map_.MergeLandmarks(keep, drop);
  EXPECT_EQ(map_.landmark(keep).observations.size(), 2u);
  EXPECT_EQ(map_.keyframe(a).landmarks[1], std::nullopt) << "its other feature is free again";
  EXPECT_EQ(map_.keyframe(b).landmarks[1], keep);
  EXPECT_EQ(map_.landmark(keep).num_visible, 1 + 10);
  EXPECT_EQ(map_.landmark(keep).num_found, 1 + 5);
  map_.MergeLandmarks(keep, keep);
  EXPECT_NE(map_.FindLandmark(keep), nullptr) << "merging with itself changes nothing";
}

TEST_F(MapTest, CovisibleKeyframesComeMostSharedFirstAndOlderFirstAmongEquals) {
  const KeyframeId center = AddKeyframe();
  const KeyframeId few = AddKeyframe();
  const KeyframeId many = AddKeyframe();
  const KeyframeId as_few = AddKeyframe();
  const KeyframeId none = AddKeyframe();
  Share({center, as_few}, 2);
  Share({center, few}, 2);
  Share({center, many}, 5);
  EXPECT_THAT(map_.CovisibleKeyframes(center, 1, 10), ElementsAre(many, few, as_few));
  EXPECT_THAT(map_.CovisibleKeyframes(center, 1, 2), ElementsAre(many, few));
  EXPECT_THAT(map_.CovisibleKeyframes(center, 3, 10), ElementsAre(many));
  EXPECT_THAT(map_.CovisibleKeyframes(center, 50, 10), ElementsAre(many)) << "the best one alone";
  EXPECT_TRUE(map_.CovisibleKeyframes(none, 1, 10).empty());
}

TEST_F(MapTest, TheParentIsTheOlderKeyframeThatSharesMost) {
  const KeyframeId a = AddKeyframe();
  const KeyframeId b = AddKeyframe();
  const KeyframeId c = AddKeyframe();
  const KeyframeId d = AddKeyframe();
  Share({a, c}, 4);
  Share({b, c}, 2);
  Share({c, d}, 9);
  map_.ChooseParent(c);
  EXPECT_EQ(map_.keyframe(c).parent, a);
  map_.ChooseParent(b);
  EXPECT_EQ(map_.keyframe(b).parent, a) << "nothing in common: the one before";
  EXPECT_EQ(map_.keyframe(a).parent, std::nullopt);
}

TEST_F(MapTest, ChildrenOfAnErasedKeyframeHangBelowOlderOnes) {
  const KeyframeId a = AddKeyframe();
  const KeyframeId b = AddKeyframe();
  const KeyframeId c = AddKeyframe();
  ASSERT_EQ(map_.keyframe(c).parent, b);
  map_.EraseKeyframe(b);
  EXPECT_EQ(map_.keyframe(c).parent, a);
}

TEST_F(MapTest, ErasingAKeyframeErasesLandmarksThatOnlyItSaw) {
  const KeyframeId a = AddKeyframe();
  const KeyframeId b = AddKeyframe();
  const KeyframeId c = AddKeyframe();
  const LandmarkId alone = Share({c}, 1).front();
  const LandmarkId shared = Share({a, b, c}, 1).front();
  map_.EraseKeyframe(c);
  EXPECT_EQ(map_.FindLandmark(alone), nullptr);
  EXPECT_EQ(map_.landmark(shared).observations.size(), 2u);
}

TEST_F(MapTest, AnAppearanceHasTheMeanDirectionFromItsObservers) {
  const KeyframeId left = AddKeyframe({Eigen::Quaterniond::Identity(), {-1, 0, 0}});
  const KeyframeId right = AddKeyframe({Eigen::Quaterniond::Identity(), {1, 0, 0}});
  const LandmarkId id = Share({left, right}, 1).front();  // At (0, 0, 2).
  const LandmarkAppearance appearance = map_.ComputeAppearance(id);
  EXPECT_LT((appearance.view_direction - Eigen::Vector3f::UnitZ()).norm(), 1e-6F);
  EXPECT_NEAR(map_.landmark(id).appearance.view_direction.x(), 1 / std::sqrt(5.0F), 1e-6)
      << "taken from the first observation until it is set";
}

TEST_F(MapTest, AnAppearancesRangeIsWhereThePyramidHoldsTheReferenceView) {
  const KeyframeId a = AddKeyframe();
  auto frame = std::make_shared<Frame>(*map_.keyframe(a).frame);
  frame->keypoints[0].octave = 3;
  const KeyframeId b = map_.AddKeyframe(frame, {Eigen::Quaterniond::Identity(), {0, 0, 0.5}});
  const LandmarkId id = map_.AddLandmark({0, 0, 2}, {b, 0});
  map_.AddObservation(id, {a, 0});
  const LandmarkAppearance appearance = map_.ComputeAppearance(id);
  EXPECT_EQ(map_.landmark(id).reference_keyframe, b);
  EXPECT_NEAR(appearance.max_distance, 1.5 * std::pow(1.2, 3), 1e-5);
  EXPECT_NEAR(appearance.min_distance, 1.5 * std::pow(1.2, 3 - 7), 1e-5);
}

TEST_F(MapTest, AnAppearanceTakesTheDescriptorWithTheLeastMedianDistance) {
  const Descriptor typical = RandomDescriptor(random_);
  std::vector<KeyframeId> keyframes;
  for (int i = 0; i < 7; ++i) {
    auto frame = std::make_shared<Frame>(*RandomFrame(5, random_));
    // The fourth is the typical one, around which all but the first lie.
    frame->descriptors[0] = i == 0   ? RandomDescriptor(random_)
                            : i == 3 ? typical
                                     : Disturb(typical, 12, random_);
    keyframes.push_back(map_.AddKeyframe(frame, {}));
  }
  const LandmarkId id = Share(keyframes, 1).front();
  EXPECT_EQ(map_.ComputeAppearance(id).descriptor, typical);
}

TEST_F(MapTest, NumTrackedLandmarksCountsThoseMeasuredOftenEnough) {
  const KeyframeId a = AddKeyframe();
  const KeyframeId b = AddKeyframe();
  Share({a}, 3);
  Share({a, b}, 4);
  EXPECT_EQ(map_.NumTrackedLandmarks(a, 2), 7);
  EXPECT_EQ(map_.NumTrackedLandmarks(a, 3), 4);
  EXPECT_EQ(map_.NumTrackedLandmarks(a, 5), 0);
}

TEST_F(MapTest, ClearingDropsAllAndIdsGoOnCounting) {
  const KeyframeId a = AddKeyframe();
  const LandmarkId landmark = Share({a}, 2).back();
  const std::uint64_t epoch = map_.epoch();
  map_.Clear();
  EXPECT_EQ(map_.num_keyframes(), 0u);
  EXPECT_EQ(map_.num_landmarks(), 0u);
  EXPECT_NE(map_.epoch(), epoch);
  EXPECT_EQ(map_.ResolvePose(a), std::nullopt);
  EXPECT_EQ(map_.ResolveLandmark(landmark), std::nullopt);
  const KeyframeId next = AddKeyframe();
  EXPECT_EQ(next.value, a.value + 1);
  EXPECT_EQ(map_.keyframe(next).parent, std::nullopt) << "the first of the new map";
  EXPECT_EQ(Share({next}, 1).front().value, landmark.value + 1);
  EXPECT_NO_THROW(map_.CheckConsistency());
}

TEST_F(MapTest, TheVersionGrowsWithEveryEdit) {
  std::uint64_t version = map_.version();
  const auto check = [&](const char* edit) {
    EXPECT_GT(map_.version(), version) << edit;
    version = map_.version();
  };
  const KeyframeId a = AddKeyframe();
  check("AddKeyframe");
  const LandmarkId landmark = Share({a}, 1).front();
  check("AddLandmark");
  const KeyframeId b = AddKeyframe();
  check("ChooseParent");
  map_.AddObservation(landmark, {b, 0});
  check("AddObservation");
  map_.SetPose(a, RandomPose(random_));
  check("SetPose");
  map_.SetPosition(landmark, {1, 2, 3});
  check("SetPosition");
  map_.SetAppearance(landmark, map_.ComputeAppearance(landmark));
  check("SetAppearance");
  map_.EraseLandmark(landmark);
  check("EraseLandmark");
  map_.EraseKeyframe(b);
  check("EraseKeyframe");
  map_.Clear();
  check("Clear");
}

TEST_F(MapTest, BrokenContractsThrowAndLeaveTheMapAsItWas) {
  const KeyframeId a = AddKeyframe();
  const KeyframeId b = AddKeyframe();
  const LandmarkId landmark = Share({a, b}, 1).front();
  const KeyframeId no_keyframe{42};
  const LandmarkId no_landmark{42};
  EXPECT_THROW(map_.keyframe(no_keyframe), std::logic_error);
  EXPECT_THROW(map_.landmark(no_landmark), std::logic_error);
  EXPECT_THROW(map_.SetPose(no_keyframe, {}), std::logic_error);
  EXPECT_THROW(map_.SetPosition(no_landmark, {}), std::logic_error);
  EXPECT_THROW(map_.EraseKeyframe(no_keyframe), std::logic_error);
  EXPECT_THROW(map_.EraseLandmark(no_landmark), std::logic_error);
  EXPECT_THROW(map_.MergeLandmarks(landmark, no_landmark), std::logic_error);
  EXPECT_THROW(map_.MergeLandmarks(no_landmark, landmark), std::logic_error);
  EXPECT_THROW(map_.ResolvePose(no_keyframe), std::logic_error);
  EXPECT_THROW(map_.ChooseParent(no_keyframe), std::logic_error);
  EXPECT_THROW(map_.AddKeyframe(nullptr, {}), std::logic_error);
  EXPECT_THROW(map_.EraseKeyframe(a), std::logic_error) << "the first one";
  EXPECT_THROW(map_.AddLandmark({0, 0, 1}, {a, 0}), std::logic_error) << "feature is taken";
  EXPECT_THROW(map_.AddLandmark({0, 0, 1}, {no_keyframe, 0}), std::logic_error);
  EXPECT_THROW(map_.AddLandmark({0, 0, 1}, {a, 100}), std::logic_error) << "no such feature";
  EXPECT_THROW(map_.AddObservation(landmark, {a, 1}), std::logic_error) << "sees it already";
  EXPECT_EQ(map_.FindKeyframe(no_keyframe), nullptr);
  EXPECT_EQ(map_.FindLandmark(no_landmark), nullptr);
  EXPECT_NO_THROW(map_.CheckConsistency());
  EXPECT_EQ(map_.num_landmarks(), 1u);
  EXPECT_EQ(map_.num_keyframes(), 2u);
  map_.RemoveObservation(landmark, b);
  EXPECT_EQ(map_.FindLandmark(landmark), nullptr) << "two measurements do not keep it";
}

class MapPiecesTest : public MapTest {
 protected:
  KeyframeId StartPiece() {
    return map_.AddKeyframe(RandomFrame(100, random_, 1), RandomPose(random_));
  }
  // A keyframe that sees what the older one sees.
  KeyframeId Follow(KeyframeId older) {
    const KeyframeId id = StartPiece();
    Share({older, id}, 3);
    map_.ChooseParent(id);
    return id;
  }
  void TearDown() override { map_.CheckConsistency(); }
};

TEST_F(MapPiecesTest, AKeyframeBelongsToThePieceOfItsParent) {
  const KeyframeId a = StartPiece();
  const KeyframeId b = StartPiece();
  const KeyframeId a2 = Follow(a);
  const KeyframeId b2 = Follow(b);
  EXPECT_EQ(map_.PieceOf(a2), a);
  EXPECT_EQ(map_.PieceOf(b2), b);
  EXPECT_THAT(map_.pieces(), ElementsAre(std::pair(a, 2u), std::pair(b, 2u)));
  EXPECT_EQ(map_.MainPiece(), a) << "the oldest of equals";
  Follow(b2);
  EXPECT_EQ(map_.MainPiece(), b) << "the one with most keyframes";
}

TEST_F(MapPiecesTest, AnErasedKeyframeKeepsItsPiece) {
  const KeyframeId a = StartPiece();
  const KeyframeId b = StartPiece();
  const KeyframeId b2 = Follow(b);
  map_.EraseKeyframe(b2);
  EXPECT_EQ(map_.PieceOf(b2), b);
  EXPECT_EQ(map_.NearestKeptAncestor(b2), b);
  EXPECT_THAT(map_.pieces(), ElementsAre(std::pair(a, 1u), std::pair(b, 1u)));
}

TEST_F(MapPiecesTest, JoinedPiecesAreOneAndRememberWhereNothingWasMeasured) {
  const KeyframeId a = StartPiece();
  const KeyframeId a2 = Follow(a);
  const KeyframeId b = StartPiece();
  const KeyframeId b2 = Follow(b);
  const KeyframeId a3 = Follow(a2);
  map_.JoinPieces(a, b);
  for (const KeyframeId id : {a, a2, a3, b, b2}) EXPECT_EQ(map_.PieceOf(id), a);
  EXPECT_EQ(map_.keyframe(b).parent, a2) << "the newest before it: parents are older";
  EXPECT_TRUE(map_.keyframe(b).starts_piece);
  EXPECT_THROW(map_.EraseKeyframe(b), std::logic_error) << "the pieces hang together by it";
  EXPECT_FALSE(map_.keyframe(b2).is_anchor());
}

TEST_F(MapPiecesTest, ADroppedPieceLeavesTheOthersAlone) {
  const KeyframeId a = StartPiece();
  const KeyframeId a2 = Follow(a);
  const KeyframeId b = StartPiece();
  const KeyframeId b2 = Follow(b);
  map_.SetWords(b2, std::make_shared<const BagOfWords>());
  const KeyframeId b3 = Follow(b2);
  map_.EraseKeyframe(b3);
  const std::uint64_t epoch = map_.epoch();
  map_.ErasePiece(b);
  EXPECT_NE(map_.epoch(), epoch);
  EXPECT_THAT(map_.KeyframeIds(), ElementsAre(a, a2));
  EXPECT_EQ(map_.num_keyframes(), 2u);
  EXPECT_EQ(map_.num_landmarks(), 3u);
  for (const KeyframeId id : {b, b2, b3}) {
    EXPECT_FALSE(map_.PieceOf(id));
    EXPECT_FALSE(map_.ResolvePose(id));
  }
}

TEST_F(MapPiecesTest, TheEndsOfALoopCannotBeErased) {
  const KeyframeId a = StartPiece();
  const KeyframeId b = Follow(a);
  const KeyframeId c = Follow(b);
  map_.TieByLoop(c, b);
  map_.TieByLoop(b, c);
  EXPECT_THAT(map_.keyframe(b).loop_partners, ElementsAre(c));
  EXPECT_THAT(map_.keyframe(c).loop_partners, ElementsAre(b));
  EXPECT_THROW(map_.EraseKeyframe(c), std::logic_error);
  const KeyframeId apart = StartPiece();
  EXPECT_THROW(map_.TieByLoop(a, apart), std::logic_error);
  EXPECT_THROW(map_.JoinPieces(apart, a), std::logic_error) << "the older one stays";
  EXPECT_THROW(map_.ErasePiece(b), std::logic_error) << "not the first of a piece";
}

}  // namespace
}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/tracking/local_map.h"

#include <chrono>
#include <set>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "map/random_frames.h"
#include "support/held_lock.h"

namespace semslam {
namespace {

using ::testing::ElementsAreArray;

// Keyframes 0 to 4; each shares landmarks with the one before, 0 and 4 share none with each other.
class LocalMapTest : public ::testing::Test {
 protected:
  LocalMapTest() {
    for (int i = 0; i < 5; ++i) AddKeyframe();
  }

  // With five landmarks of its own and five that the next will see too.
  void AddKeyframe() {
    map_.Write([&](Map& map) {
      const KeyframeId id = map.AddKeyframe(testing::RandomFrame(30, random_, 1), {});
      int feature = 0;
      for (const LandmarkId shared : to_share_) map.AddObservation(shared, {id, feature++});
      to_share_.clear();
      std::vector<LandmarkId> own;
      for (int i = 0; i < 10; ++i) {
        const Eigen::Vector3d p_world(random_.Uniform(), random_.Uniform(), 2);
        const LandmarkId landmark = map.AddLandmark(p_world, {id, feature++});
        (i < 5 ? own : to_share_).push_back(landmark);
      }
      own_.push_back(own);
      map.ChooseParent(id);
    });
  }
  // A frame that shows the landmarks that only this keyframe sees.
  TrackedFrame FrameOf(const std::vector<LandmarkId>& landmarks) const {
    TrackedFrame frame;
    for (const LandmarkId id : landmarks) {
      frame.points.push_back(TrackedPoint{id, Eigen::Vector3d::Zero()});
      frame.points.push_back(std::nullopt);
    }
    frame.points.push_back(
        TrackedPoint{std::nullopt, Eigen::Vector3d::Zero()});  // A temporary point.
    return frame;
  }
  std::vector<LandmarkId> SeenBy(const std::vector<std::uint32_t>& keyframes) const {
    return map_.Read([&](const Map& map) {
      std::set<LandmarkId> ids;
      for (const std::uint32_t keyframe : keyframes) {
        for (const auto& id : map.keyframe(KeyframeId{keyframe}).landmarks) {
          if (id) ids.insert(*id);
        }
      }
      return std::vector<LandmarkId>(ids.begin(), ids.end());
    });
  }
  std::vector<LandmarkId> Ids() const {
    std::vector<LandmarkId> ids;
    for (const LandmarkCopy& entry : local_map_.landmarks()) ids.push_back(entry.id);
    return ids;
  }

  Random random_{9};
  SharedMap map_;
  std::vector<LandmarkId> to_share_;
  std::vector<std::vector<LandmarkId>> own_;  // By keyframe.
  LocalMap local_map_;
};

TEST_F(LocalMapTest, TakesTheLandmarksOfTheKeyframesInViewAndTheirNeighbours) {
  ASSERT_TRUE(local_map_.Update(map_, FrameOf(own_[4]), 0));
  EXPECT_EQ(local_map_.reference_keyframe(), KeyframeId{4});
  EXPECT_THAT(Ids(), ElementsAreArray(SeenBy({3, 4}))) << "4 and its neighbour and parent 3";
}

TEST_F(LocalMapTest, TheReferenceIsTheKeyframeThatSharesMost) {
  std::vector<LandmarkId> landmarks = own_[1];
  landmarks.push_back(own_[3].front());
  ASSERT_TRUE(local_map_.Update(map_, FrameOf(landmarks), 0));
  EXPECT_EQ(local_map_.reference_keyframe(), KeyframeId{1});
  EXPECT_THAT(Ids(), ElementsAreArray(SeenBy({0, 1, 2, 3})));
}

TEST_F(LocalMapTest, CopiesTheLandmarksAsTheyAre) {
  ASSERT_TRUE(local_map_.Update(map_, FrameOf(own_[0]), 0));
  map_.Read([&](const Map& map) {
    for (const LandmarkCopy& entry : local_map_.landmarks()) {
      EXPECT_EQ(entry.appearance.p_world, map.landmark(entry.id).appearance.p_world);
      EXPECT_EQ(entry.appearance.descriptor, map.landmark(entry.id).appearance.descriptor);
    }
  });
}

TEST_F(LocalMapTest, SkipsTheCopyIfNothingHasChanged) {
  ASSERT_TRUE(local_map_.Update(map_, FrameOf(own_[0]), 0));
  const LandmarkCopy* const copy = local_map_.landmarks().data();
  ASSERT_TRUE(local_map_.Update(map_, FrameOf({own_[0][1], own_[0][2]}), 0));
  EXPECT_EQ(local_map_.landmarks().data(), copy);
}

TEST_F(LocalMapTest, FollowsAnEditOfTheMap) {
  ASSERT_TRUE(local_map_.Update(map_, FrameOf(own_[0]), 0));
  map_.Write([&](Map& map) { map.SetPosition(own_[0][2], {7, 8, 9}); });
  ASSERT_TRUE(local_map_.Update(map_, FrameOf(own_[0]), 0));
  EXPECT_EQ(local_map_.landmarks()[2].id, own_[0][2]);
  EXPECT_EQ(local_map_.landmarks()[2].appearance.p_world, Eigen::Vector3d(7, 8, 9));
}

TEST_F(LocalMapTest, ServesOnceMoreWhileOthersHoldTheMap) {
  ASSERT_TRUE(local_map_.Update(map_, FrameOf(own_[0]), 0));
  const std::vector<LandmarkId> before = Ids();
  testing::HeldLock<Map> holder(map_);
  ASSERT_TRUE(local_map_.Update(map_, FrameOf(own_[4]), 0));
  EXPECT_EQ(local_map_.reference_keyframe(), KeyframeId{0});
  EXPECT_EQ(Ids(), before);
  holder.Release();
  ASSERT_TRUE(local_map_.Update(map_, FrameOf(own_[4]), 0));
  EXPECT_EQ(local_map_.reference_keyframe(), KeyframeId{4});
}

TEST_F(LocalMapTest, WaitsForTheMapIfTheCopyIsOfAnotherEpoch) {
  ASSERT_TRUE(local_map_.Update(map_, FrameOf(own_[0]), 0));
  EXPECT_EQ(local_map_.epoch(), 0u);
  testing::HeldLock<Map> holder(map_, [](Map& map) { map.Correct({}); });
  const std::jthread releaser([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    holder.Release();
  });
  ASSERT_TRUE(local_map_.Update(map_, FrameOf(own_[4]), 1));
  EXPECT_EQ(local_map_.reference_keyframe(), KeyframeId{4});
  EXPECT_EQ(local_map_.epoch(), 1u);
}

TEST_F(LocalMapTest, FollowsTheFrameToOtherKeyframes) {
  ASSERT_TRUE(local_map_.Update(map_, FrameOf(own_[0]), 0));
  ASSERT_TRUE(local_map_.Update(map_, FrameOf(own_[4]), 0));
  EXPECT_THAT(Ids(), ElementsAreArray(SeenBy({3, 4})));
}

TEST_F(LocalMapTest, StaysAsItWasWhenTheFrameSharesNothing) {
  ASSERT_TRUE(local_map_.Update(map_, FrameOf(own_[0]), 0));
  const std::vector<LandmarkId> before = Ids();
  EXPECT_FALSE(local_map_.Update(map_, FrameOf({}), 0));
  EXPECT_FALSE(local_map_.Update(map_, FrameOf({LandmarkId{999}}), 0)) << "erased or unknown";
  EXPECT_EQ(Ids(), before);
  EXPECT_EQ(local_map_.reference_keyframe(), KeyframeId{0});
}

TEST_F(LocalMapTest, TakesEightyKeyframesOfManyAtMostBesidesThoseInView) {
  for (int i = 5; i < 200; ++i) AddKeyframe();
  std::vector<LandmarkId> landmarks;
  for (int i = 0; i < 75; ++i) landmarks.push_back(own_[2 * i].front());
  ASSERT_TRUE(local_map_.Update(map_, FrameOf(landmarks), 0));
  // 75 in view and about five neighbours: each keyframe has ten landmarks that the one before has
  // not, and the first ten more.
  EXPECT_GE(local_map_.landmarks().size(), 10u * 75);
  EXPECT_LE(local_map_.landmarks().size(), 15u * 81);
}

}  // namespace
}  // namespace semslam

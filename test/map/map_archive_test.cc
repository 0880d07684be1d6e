// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/map/map_archive.h"

#include <span>
#include <string>

#include <gtest/gtest.h>

#include "semslam/base/error.h"
#include "semslam/place/vocabulary_training.h"

#include "map/random_frames.h"
#include "place/random_descriptors.h"

namespace semslam {
namespace {

using testing::RandomFrame;
using testing::RandomPose;

constexpr PinholeCamera::Bounds kBounds = {0, 0, 640, 480};

class MapArchiveTest : public ::testing::Test {
 protected:
  MapArchiveTest() : vocabulary_(MakeVocabulary()) {}

  static Vocabulary MakeVocabulary() {
    const auto images = RandomPlaces(10, 2, 40, 5);
    return TrainVocabulary(images, {.branching = 5, .depth = 2, .max_iterations = 3}, 1);
  }

  // Six keyframes with landmarks, some of them merged or erased; one keyframe erased.
  Map MakeMap() {
    Map map;
    for (int k = 0; k < 6; ++k) {
      const KeyframeId id = map.AddKeyframe(RandomFrame(40, random_), RandomPose(random_));
      for (int feature = 0; feature < 20; ++feature) {
        map.AddLandmark({0.1 * feature, 0.2, 2}, {id, feature});
      }
      if (k > 0) ShareWithPrevious(map, id);
      map.ChooseParent(id);
      const auto words = vocabulary_.Transform(map.keyframe(id).frame->descriptors);
      if (k != 3) map.SetWords(id, std::make_shared<const BagOfWords>(words));
    }
    map.MergeLandmarks(LandmarkId{3}, LandmarkId{30});
    map.EraseLandmark(LandmarkId{50});
    map.CountSightings(LandmarkId{4}, 7, 5);
    map.EraseKeyframe(KeyframeId{4});
    map.TieByLoop(KeyframeId{5}, KeyframeId{1});
    AddPiece(map);
    const KeyframeId joined = AddPiece(map);
    map.JoinPieces(KeyframeId{0}, joined);
    return map;
  }
  // Two keyframes that have nothing to do with the others.
  KeyframeId AddPiece(Map& map) {
    const KeyframeId first = map.AddKeyframe(RandomFrame(40, random_), RandomPose(random_));
    for (int feature = 0; feature < 20; ++feature)
      map.AddLandmark({0.1 * feature, 0.2, 2}, {first, feature});
    const KeyframeId second = map.AddKeyframe(RandomFrame(40, random_), RandomPose(random_));
    ShareWithPrevious(map, second);
    map.ChooseParent(second);
    return first;
  }
  static void ShareWithPrevious(Map& map, KeyframeId id) {
    const KeyframeId previous{id.value - 1};
    for (int feature = 0; feature < 15; ++feature) {
      const std::optional<LandmarkId> landmark = map.keyframe(previous).landmarks[feature];
      if (landmark) map.AddObservation(*landmark, {id, 20 + feature});
    }
  }

  static std::string Bytes(const Map& map) {
    BinaryWriter writer;
    MapArchive::Write(map, &writer);
    return writer.bytes();
  }
  Map Parse(const std::string& bytes) const {
    BinaryReader reader(std::as_bytes(std::span(bytes.data(), bytes.size())), "map");
    return MapArchive::Read(&reader, kBounds, vocabulary_);
  }

  Random random_{3};
  Vocabulary vocabulary_;
};

TEST_F(MapArchiveTest, GivesBackTheSameMap) {
  const Map map = MakeMap();
  const Map copy = Parse(Bytes(map));
  copy.CheckConsistency();
  EXPECT_EQ(Bytes(copy), Bytes(map));
  EXPECT_EQ(copy.KeyframeIds(), map.KeyframeIds());
  EXPECT_EQ(copy.pieces(), map.pieces());
  EXPECT_EQ(copy.keyframe(KeyframeId{1}).loop_partners, map.keyframe(KeyframeId{1}).loop_partners);
  EXPECT_EQ(copy.LandmarkIds(), map.LandmarkIds());
  for (const KeyframeId id : map.KeyframeIds()) {
    const Keyframe& expected = map.keyframe(id);
    const Keyframe& found = copy.keyframe(id);
    EXPECT_EQ(found.T_world_camera.ToMatrix(), expected.T_world_camera.ToMatrix());
    EXPECT_EQ(found.landmarks, expected.landmarks);
    EXPECT_EQ(found.parent, expected.parent);
    EXPECT_EQ(found.words != nullptr, expected.words != nullptr);
    EXPECT_EQ(copy.CovisibleKeyframes(id, 1, 10), map.CovisibleKeyframes(id, 1, 10));
  }
  EXPECT_EQ(copy.ResolvePose(KeyframeId{4})->ToMatrix(),
            map.ResolvePose(KeyframeId{4})->ToMatrix());
  EXPECT_EQ(copy.landmark(LandmarkId{4}).num_visible, 8);
  EXPECT_EQ(copy.landmark(LandmarkId{3}).num_measurements,
            map.landmark(LandmarkId{3}).num_measurements);
}

TEST_F(MapArchiveTest, FindsPlacesInTheCopy) {
  const Map map = MakeMap();
  const Map copy = Parse(Bytes(map));
  const auto& words = map.keyframe(KeyframeId{2}).words->vector;
  const auto found = copy.keyframe_index().FindSimilar(words);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().keyframe, KeyframeId{2});
}

TEST_F(MapArchiveTest, IdsGoOnCountingInTheCopy) {
  Map copy = Parse(Bytes(MakeMap()));
  EXPECT_EQ(copy.AddKeyframe(RandomFrame(5, random_), {}), KeyframeId{10});
  EXPECT_EQ(copy.AddLandmark({0, 0, 1}, {KeyframeId{10}, 0}), LandmarkId{160});
}

TEST_F(MapArchiveTest, AnEmptyAndAClearedMapAreMapsToo) {
  EXPECT_EQ(Parse(Bytes(Map())).num_keyframes(), 0u);
  Map map = MakeMap();
  map.Clear();
  Map copy = Parse(Bytes(map));
  EXPECT_EQ(copy.num_keyframes(), 0u);
  EXPECT_EQ(copy.AddKeyframe(RandomFrame(5, random_), {}), KeyframeId{10});
}

TEST_F(MapArchiveTest, DamagedBytesAreRefusedOrMakeAConsistentMap) {
  const std::string bytes = Bytes(MakeMap());
  int num_refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string damaged = bytes;
    const int num_changes = 1 + static_cast<int>(random_.Index(3));
    for (int k = 0; k < num_changes; ++k) {
      damaged[random_.Index(static_cast<std::uint32_t>(damaged.size()))] =
          static_cast<char>(random_.Index(256));
    }
    if (i % 4 == 0) damaged.resize(random_.Index(static_cast<std::uint32_t>(damaged.size())));
    try {
      Parse(damaged).CheckConsistency();
    } catch (const InputError&) {
      ++num_refused;
    }
  }
  EXPECT_GT(num_refused, 500);
  EXPECT_LT(num_refused, 2000) << "many bytes may have any value";
}

}  // namespace
}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// Long random sequences of edits, against a plain record of who sees what.
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semslam/map/map.h"

#include "map/random_frames.h"
#include "support/matchers.h"

namespace semslam {
namespace {

// Applies random edits to a Map and keeps the obvious record beside it.
class Editor {
 public:
  explicit Editor(std::uint64_t seed) : random_(seed) { AddKeyframe(); }

  void EditOnce() {
    switch (random_.Index(10)) {
      case 0:
        return AddKeyframe();
      case 1:
      case 2:
      case 3:
        return AddLandmark();
      case 4:
      case 5:
      case 6:
        return AddObservation();
      case 7:
        return random_.Index(2) == 0 ? MergeLandmarks() : ChooseParent();
      case 8:
        return random_.Index(4) == 0 ? EraseLandmark() : RemoveObservation();
      default:
        return random_.Index(3) == 0 ? EraseKeyframe() : AddObservation();
    }
  }

  // Fails the test where the map differs from the record.
  void Compare() const {
    ASSERT_NO_THROW(map_.CheckConsistency());
    ASSERT_EQ(map_.LandmarkIds().size(), record_.size());
    ASSERT_EQ(map_.num_landmarks(), record_.size());
    ASSERT_EQ(map_.num_keyframes(), map_.KeyframeIds().size());
    std::map<std::pair<KeyframeId, KeyframeId>, int> shared;
    for (const auto& [id, seen_by] : record_) {
      const Landmark* landmark = map_.FindLandmark(id);
      ASSERT_NE(landmark, nullptr) << id.value;
      int num_measurements = 0;
      ASSERT_EQ(landmark->observations.size(), seen_by.size());
      for (const Observation& observation : landmark->observations) {
        ASSERT_TRUE(seen_by.contains(observation.keyframe));
        ASSERT_EQ(seen_by.at(observation.keyframe), observation.feature);
        num_measurements += observation.feature % 2 == 0 ? 2 : 1;
        for (const auto& [other, feature] : seen_by) {
          if (other != observation.keyframe) ++shared[{observation.keyframe, other}];
        }
      }
      ASSERT_EQ(landmark->num_measurements, num_measurements);
    }
    std::size_t num_edges = 0;
    for (const KeyframeId id : map_.KeyframeIds()) {
      for (const CovisibleKeyframe& covisible : map_.keyframe(id).covisible) {
        ++num_edges;
        ASSERT_EQ(covisible.num_shared, (shared[{id, covisible.id}]));
      }
    }
    ASSERT_EQ(num_edges, shared.size());
    for (const auto& [id, pose] : poses_) {
      ASSERT_THAT(map_.ResolvePose(id), ::testing::Optional(testing::Rigid3Near(pose, 1e-9, 1e-9)));
    }
  }

  const Map& map() const { return map_; }

 private:
  using SeenBy = std::map<KeyframeId, int>;

  KeyframeId RandomKeyframe() {
    const std::vector<KeyframeId> ids = map_.KeyframeIds();
    return ids[random_.Index(static_cast<std::uint32_t>(ids.size()))];
  }
  std::optional<LandmarkId> RandomLandmark() {
    if (record_.empty()) return std::nullopt;
    auto it = record_.begin();
    std::advance(it, random_.Index(static_cast<std::uint32_t>(record_.size())));
    return it->first;
  }
  std::optional<int> FreeFeature(KeyframeId id) {
    const std::vector<std::optional<LandmarkId>>& landmarks = map_.keyframe(id).landmarks;
    for (int attempt = 0; attempt < 5; ++attempt) {
      const int feature = static_cast<int>(random_.Index(kNumFeatures));
      if (!landmarks[feature]) return feature;
    }
    return std::nullopt;
  }

  void AddKeyframe() {
    const Rigid3 pose = testing::RandomPose(random_);
    const KeyframeId id = map_.AddKeyframe(testing::RandomFrame(kNumFeatures, random_), pose);
    if (id.value > 0) map_.ChooseParent(id);
    poses_[id] = pose;
  }
  void AddLandmark() {
    const KeyframeId keyframe = RandomKeyframe();
    if (const std::optional<int> feature = FreeFeature(keyframe)) {
      const Eigen::Vector3d p_world = testing::RandomPose(random_).translation;
      record_[map_.AddLandmark(p_world, {keyframe, *feature})] = {{keyframe, *feature}};
    }
  }
  void AddObservation() {
    const std::optional<LandmarkId> landmark = RandomLandmark();
    const KeyframeId keyframe = RandomKeyframe();
    const std::optional<int> feature = FreeFeature(keyframe);
    if (!landmark || !feature || map_.Sees(keyframe, *landmark)) return;
    map_.AddObservation(*landmark, {keyframe, *feature});
    record_[*landmark][keyframe] = *feature;
  }
  void MergeLandmarks() {
    const std::optional<LandmarkId> keep = RandomLandmark();
    const std::optional<LandmarkId> drop = RandomLandmark();
    if (!keep || keep == drop) return;
    map_.MergeLandmarks(*keep, *drop);
    record_[*keep].merge(record_[*drop]);
    record_.erase(*drop);
    ASSERT_EQ(map_.ResolveLandmark(*drop), keep);
  }
  void RemoveObservation() {
    const std::optional<LandmarkId> landmark = RandomLandmark();
    if (!landmark) return;
    const KeyframeId keyframe = record_[*landmark].begin()->first;
    map_.RemoveObservation(*landmark, keyframe);
    Forget(*landmark, keyframe);
  }
  void EraseLandmark() {
    const std::optional<LandmarkId> landmark = RandomLandmark();
    if (!landmark) return;
    map_.EraseLandmark(*landmark);
    record_.erase(*landmark);
    ASSERT_EQ(map_.ResolveLandmark(*landmark), std::nullopt);
  }
  void EraseKeyframe() {
    const KeyframeId keyframe = RandomKeyframe();
    if (keyframe.value == 0) return;
    map_.EraseKeyframe(keyframe);
    std::vector<LandmarkId> seen;
    for (const auto& [id, seen_by] : record_) {
      if (seen_by.contains(keyframe)) seen.push_back(id);
    }
    for (const LandmarkId id : seen) Forget(id, keyframe);
  }
  void ChooseParent() {
    const KeyframeId keyframe = RandomKeyframe();
    if (keyframe.value > 0) map_.ChooseParent(keyframe);
  }

  // Two measurements, or fewer, are too few to keep a landmark.
  void Forget(LandmarkId landmark, KeyframeId keyframe) {
    SeenBy& seen_by = record_.at(landmark);
    seen_by.erase(keyframe);
    int num_measurements = 0;
    for (const auto& [id, feature] : seen_by) num_measurements += feature % 2 == 0 ? 2 : 1;
    if (num_measurements <= 2) record_.erase(landmark);
  }

  static constexpr int kNumFeatures = 24;
  Random random_;
  Map map_;
  std::map<LandmarkId, SeenBy> record_;
  std::map<KeyframeId, Rigid3> poses_;  // Of all keyframes there ever were.
};

class RandomEdits : public ::testing::TestWithParam<int> {};

TEST_P(RandomEdits, LeaveTheMapAsARecordOfThemSays) {
  Editor editor(GetParam());
  for (int step = 0; step < 400; ++step) {
    ASSERT_NO_FATAL_FAILURE(editor.EditOnce()) << "step " << step;
    ASSERT_NO_FATAL_FAILURE(editor.Compare()) << "step " << step;
  }
  EXPECT_GT(editor.map().num_keyframes(), 5u) << "the sequence did not get far";
  EXPECT_GT(editor.map().num_landmarks(), 20u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomEdits, ::testing::Values(1, 2, 3, 4));

}  // namespace
}  // namespace semslam

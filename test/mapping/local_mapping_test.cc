// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/mapping/local_mapping.h"

#include <map>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/matchers.h"
#include "support/synthetic_frames.h"

namespace semslam {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::Rigid3Near;
using ::testing::SizeIs;
using testing::SyntheticView;
using testing::SyntheticWorld;

bool Never() { return false; }
bool Always() { return true; }

class LocalMappingTest : public ::testing::Test {
 protected:
  // Half of the points have no depth.
  static const SyntheticWorld& World() {
    static const SyntheticWorld world({.num_points = 1200, .depth_share = 0.5});
    return world;
  }
  static std::shared_ptr<const Vocabulary> Words() {
    static const std::shared_ptr<const Vocabulary> vocabulary = World().Train();
    return vocabulary;
  }
  static bool HasDepth(const SyntheticView& view, std::size_t feature) {
    return view.frame->keypoints[feature].has_depth();
  }

  // A keyframe at a frame of the path, seeing the landmarks of the points chosen, all of which it
  // makes if they are not there yet. `offset` is added to the true pose.
  template <typename Choose>
  KeyframeId AddKeyframe(int number, Choose&& choose, const Vector6d& offset = Vector6d::Zero()) {
    const SyntheticView view = World().LookAlongPath(number);
    const KeyframeId id = map_.Write([&](Map& map) {
      const KeyframeId keyframe = map.AddKeyframe(view.frame, Retract(view.T_world_camera, offset));
      for (std::size_t i = 0; i < view.points.size(); ++i) {
        const int point = view.points[i];
        if (!choose(view, i)) continue;
        const Observation observation{keyframe, static_cast<int>(i)};
        const auto [it, is_new] = landmark_of_point_.try_emplace(point);
        if (is_new || map.FindLandmark(it->second) == nullptr) {
          it->second = map.AddLandmark(World().p_world(point) + PointNoise(), observation);
        } else {
          map.AddObservation(it->second, observation);
        }
      }
      map.ChooseParent(keyframe);
      return keyframe;
    });
    views_.push_back(view);
    return id;
  }
  KeyframeId AddKeyframe(int number) { return AddKeyframe(number, HasDepth); }

  Eigen::Vector3d PointNoise() {
    return point_noise_ *
           Eigen::Vector3d(random_.Gaussian(), random_.Gaussian(), random_.Gaussian());
  }

  LocalMapping::Report Process(KeyframeId keyframe, bool (*should_stop)() = Never) {
    const LocalMapping::Report report = mapping_.Process(keyframe, should_stop);
    map_.Read([](const Map& map) { map.CheckConsistency(); });
    return report;
  }

  // Mean distance of landmarks from the points that their first observers see in them.
  double MeanPointError() const {
    return map_.Read([&](const Map& map) {
      double sum = 0;
      for (const LandmarkId id : map.LandmarkIds()) sum += PointError(map, id);
      return sum / static_cast<double>(map.num_landmarks());
    });
  }
  double PointError(const Map& map, LandmarkId id) const {
    const Observation& first = map.landmark(id).observations.front();
    const int point = views_[first.keyframe.value].points[first.feature];
    return (map.landmark(id).appearance.p_world - World().p_world(point)).norm();
  }
  double MaxPoseError() const {
    return map_.Read([&](const Map& map) {
      double worst = 0;
      for (const KeyframeId id : map.KeyframeIds()) {
        const Rigid3& truth = views_[id.value].T_world_camera;
        worst = std::max(worst,
                         (map.keyframe(id).T_world_camera.translation - truth.translation).norm());
      }
      return worst;
    });
  }
  std::size_t NumLandmarks() const {
    return map_.Read([](const Map& map) { return map.num_landmarks(); });
  }

  Random random_{13};
  double point_noise_ = 0;
  SharedMap map_;
  std::map<int, LandmarkId> landmark_of_point_;
  std::vector<SyntheticView> views_;  // By keyframe.
  LocalMapping mapping_{{}, World().camera(), SyntheticWorld::kBaselineTimesFx, Words(), map_};
};

Vector6d PoseNoise(Random& random) {
  Vector6d noise;
  for (int i = 0; i < 6; ++i) noise[i] = (i < 3 ? 0.002 : 0.006) * random.Gaussian();
  return noise;
}

TEST_F(LocalMappingTest, LowersTheErrorOfPosesAndPoints) {
  point_noise_ = 0.01;
  KeyframeId last = AddKeyframe(0);
  for (int i = 1; i < 6; ++i) last = AddKeyframe(15 * i, HasDepth, PoseNoise(random_));
  const double pose_error = MaxPoseError();
  const double point_error = MeanPointError();
  ASSERT_GT(pose_error, 0.005);
  ASSERT_GT(point_error, 0.01);
  const LocalMapping::Report report = Process(last);
  EXPECT_TRUE(report.adjusted);
  EXPECT_LT(MaxPoseError(), 0.05 * pose_error);
  EXPECT_LT(MeanPointError(), 0.1 * point_error);
  EXPECT_THAT(map_.Read([](const Map& map) { return map.keyframe(KeyframeId{0}).T_world_camera; }),
              Rigid3Near(Rigid3(), 0, 0))
      << "the first keyframe is the world";
}

TEST_F(LocalMappingTest, RemovesObservationsThatDoNotFit) {
  for (const int number : {0, 12, 24, 36, 48}) AddKeyframe(number);
  const KeyframeId last = AddKeyframe(60);
  // Two landmarks of the last keyframe swapped: neither fits there.
  std::vector<std::pair<LandmarkId, int>> wrong;
  map_.Write([&](Map& map) {
    for (std::size_t i = 0; i < map.keyframe(last).landmarks.size() && wrong.size() < 2; ++i) {
      const auto id = map.keyframe(last).landmarks[i];
      if (id && map.landmark(*id).observations.size() == 6) wrong.emplace_back(*id, i);
    }
    for (const auto& [id, feature] : wrong) map.RemoveObservation(id, last);
    map.AddObservation(wrong[0].first, {last, wrong[1].second});
    map.AddObservation(wrong[1].first, {last, wrong[0].second});
  });
  Process(last);
  map_.Read([&](const Map& map) {
    for (const auto& [id, feature] : wrong) {
      ASSERT_NE(map.FindLandmark(id), nullptr);
      const auto other = feature == wrong[0].second ? wrong[1].second : wrong[0].second;
      for (const Observation& observation : map.landmark(id).observations) {
        EXPECT_FALSE(observation.keyframe == last && observation.feature == other);
      }
    }
  });
}

TEST_F(LocalMappingTest, TriangulatesPointsWithoutDepth) {
  for (const int number : {0, 30, 45}) Process(AddKeyframe(number));
  const std::size_t before = NumLandmarks();
  const KeyframeId last = AddKeyframe(60);
  const LocalMapping::Report report = Process(last);
  EXPECT_GT(report.num_triangulated, 20);
  int num_without_depth = 0;
  map_.Read([&](const Map& map) {
    for (std::size_t i = 0; i < map.keyframe(last).landmarks.size(); ++i) {
      const auto id = map.keyframe(last).landmarks[i];
      if (!id || HasDepth(views_[last.value], i)) continue;
      ++num_without_depth;
      EXPECT_LT(PointError(map, *id), 0.01) << "landmark " << id->value;
      EXPECT_GE(map.landmark(*id).observations.size(), 2u);
    }
  });
  EXPECT_GT(num_without_depth, 50);
  EXPECT_GT(NumLandmarks(), before);
}

TEST_F(LocalMappingTest, FusesLandmarksOfTheSamePoint) {
  Process(AddKeyframe(0));
  // Of what the second sees, a third are new landmarks of points that the first knows.
  const std::map<int, LandmarkId> of_the_first = landmark_of_point_;
  std::size_t num_duplicates = 0;
  for (auto it = landmark_of_point_.begin(); it != landmark_of_point_.end();) {
    it = it->first % 3 == 0 ? landmark_of_point_.erase(it) : std::next(it);
  }
  const KeyframeId second = AddKeyframe(25);
  for (const auto& [point, id] : landmark_of_point_) {
    const auto known = of_the_first.find(point);
    if (known != of_the_first.end() && known->second != id) ++num_duplicates;
  }
  ASSERT_GT(num_duplicates, 30u);
  const LocalMapping::Report report = Process(second);
  EXPECT_GE(report.num_fused, static_cast<int>(0.9 * static_cast<double>(num_duplicates)));
  std::size_t num_left = 0;
  map_.Read([&](const Map& map) {
    for (const auto& [point, id] : landmark_of_point_) {
      const auto known = of_the_first.find(point);
      if (known == of_the_first.end() || known->second == id) continue;
      const auto a = map.ResolveLandmark(known->second);
      const auto b = map.ResolveLandmark(id);
      if (a && b && a != b) ++num_left;
    }
  });
  EXPECT_LE(num_left, num_duplicates / 20);
}

TEST_F(LocalMappingTest, DropsNewLandmarksThatTrackingDoesNotFind) {
  Process(AddKeyframe(0));
  const KeyframeId second = AddKeyframe(30);
  std::vector<LandmarkId> bad;
  map_.Write([&](Map& map) {
    for (const LandmarkId id : map.LandmarkIds()) {
      if (map.landmark(id).first_keyframe != second) continue;
      const bool is_bad = bad.size() < 5;
      if (is_bad) bad.push_back(id);
      map.CountSightings(id, 19, is_bad ? 3 : 10);
    }
  });
  ASSERT_THAT(bad, SizeIs(5));
  const LocalMapping::Report report = Process(second);
  EXPECT_EQ(report.num_landmarks_culled, 5);
  map_.Read([&](const Map& map) {
    for (const LandmarkId id : bad) EXPECT_EQ(map.FindLandmark(id), nullptr);
  });
}

TEST_F(LocalMappingTest, DropsNewLandmarksThatTwoKeyframesLaterAreNotSeenAgain) {
  const KeyframeId first = AddKeyframe(0);
  Process(first);
  const auto seen_again = [](const SyntheticView& view, std::size_t i) {
    return HasDepth(view, i) && view.points[i] % 4 != 0;
  };
  // Fusion would find the others in the newer keyframes; so it is told to stop.
  Process(AddKeyframe(10, seen_again), Always);
  const KeyframeId third = AddKeyframe(20, seen_again);
  const LocalMapping::Report report = Process(third, Always);
  int num_seen_once = 0;
  map_.Read([&](const Map& map) {
    for (std::size_t i = 0; i < views_[0].points.size(); ++i) {
      if (!HasDepth(views_[0], i)) continue;
      const int point = views_[0].points[i];
      if (point % 4 == 0) {
        ++num_seen_once;
        EXPECT_EQ(map.FindLandmark(landmark_of_point_.at(point)), nullptr);
      }
    }
  });
  EXPECT_GT(num_seen_once, 20);
  EXPECT_GE(report.num_landmarks_culled, num_seen_once);
  EXPECT_LE(report.num_landmarks_culled, num_seen_once + 30) << "and those that left the view";
}

TEST_F(LocalMappingTest, DropsKeyframesThatAddNothing) {
  const std::vector<int> close_together{0, 3, 6, 9, 12, 15};
  KeyframeId last;
  for (const int number : close_together) last = AddKeyframe(number);
  const LocalMapping::Report report = Process(last);
  EXPECT_THAT(report.keyframes_culled, Not(IsEmpty()));
  EXPECT_THAT(report.keyframes_culled, Each(Not(KeyframeId{0}))) << "the first stays";
  EXPECT_THAT(report.keyframes_culled, Each(Not(last))) << "the newest stays";
  map_.Read([&](const Map& map) {
    EXPECT_EQ(map.num_keyframes(), close_together.size() - report.keyframes_culled.size());
    EXPECT_GE(map.num_keyframes(), 3u) << "with three left, none has three others";
    for (const KeyframeId id : report.keyframes_culled) {
      EXPECT_EQ(map.FindKeyframe(id), nullptr);
      EXPECT_THAT(map.ResolvePose(id),
                  ::testing::Optional(Rigid3Near(views_[id.value].T_world_camera, 1e-4, 1e-4)));
    }
  });
}

TEST_F(LocalMappingTest, KeepsKeyframesThatSeeThingsOfTheirOwn) {
  KeyframeId last;
  for (int i = 0; i < 5; ++i) {
    // Each point is in two of the keyframes only.
    last = AddKeyframe(3 * i, [&](const SyntheticView& view, std::size_t feature) {
      const int point = view.points[feature];
      return HasDepth(view, feature) && (point % 5 == i || (point + 1) % 5 == i);
    });
  }
  EXPECT_THAT(mapping_.Process(last, Always).keyframes_culled, IsEmpty());
}

TEST_F(LocalMappingTest, SkipsWhatCanWaitWhenANewerKeyframeWaits) {
  AddKeyframe(0);
  AddKeyframe(30);
  const KeyframeId last = AddKeyframe(45, HasDepth, PoseNoise(random_));
  const double before = MaxPoseError();
  const LocalMapping::Report report = Process(last, Always);
  EXPECT_FALSE(report.is_void);
  EXPECT_FALSE(report.adjusted);
  EXPECT_EQ(report.num_fused, 0);
  EXPECT_THAT(report.keyframes_culled, IsEmpty());
  EXPECT_DOUBLE_EQ(MaxPoseError(), before);
  EXPECT_NE(map_.Read([&](const Map& map) { return map.keyframe(last).words; }), nullptr)
      << "the words are needed to track";
}

TEST_F(LocalMappingTest, AnAdjustmentThatIsStoppedIsNotReportedAsFinished) {
  AddKeyframe(0);
  AddKeyframe(30);
  const KeyframeId last = AddKeyframe(45, HasDepth, PoseNoise(random_));
  int num_asked = 0;
  const double before = MaxPoseError();
  // Asked once a neighbour, before fusion and before the adjustment; then it is on its way.
  const LocalMapping::Report report = mapping_.Process(last, [&] { return ++num_asked > 5; });
  EXPECT_FALSE(report.adjusted);
  EXPECT_LE(MaxPoseError(), before) << "the best state so far is kept";
  map_.Read([](const Map& map) { map.CheckConsistency(); });
}

TEST_F(LocalMappingTest, AKeyframeOfAClearedMapIsVoid) {
  const KeyframeId first = AddKeyframe(0);
  map_.Write([](Map& map) { map.Clear(); });
  const LocalMapping::Report report = Process(first);
  EXPECT_TRUE(report.is_void);
  EXPECT_EQ(report.keyframe, first);
  EXPECT_TRUE(Process(KeyframeId{77}).is_void);
  landmark_of_point_.clear();
  EXPECT_FALSE(Process(AddKeyframe(3)).is_void) << "it goes on with the new map";
}

TEST_F(LocalMappingTest, RefusesSenselessOptions) {
  LocalMapping::Options options;
  options.redundant_ratio = 1.5;
  EXPECT_THROW(LocalMapping(options, World().camera(), 40, Words(), map_), std::logic_error);
  EXPECT_THROW(LocalMapping({}, World().camera(), 40, nullptr, map_), std::logic_error);
}

}  // namespace
}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/features/projection_matcher.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semslam/base/random.h"

#include "place/random_descriptors.h"

namespace semslam {

inline bool operator==(const FeatureMatch& a, const FeatureMatch& b) {
  return a.query == b.query && a.feature == b.feature && a.distance == b.distance;
}
inline void PrintTo(const FeatureMatch& match, std::ostream* stream) {
  *stream << match.query << " -> " << match.feature << " (" << match.distance << " bits)";
}

namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr PinholeCamera::Bounds kBounds{0, 0, 640, 480};

Frame MakeFrame(const std::vector<Keypoint>& keypoints,
                const std::vector<Descriptor>& descriptors) {
  Frame frame;
  frame.keypoints = keypoints;
  frame.descriptors = descriptors;
  frame.grid = FeatureGrid(frame.keypoints, kBounds);
  return frame;
}

Frame RandomFrame(int num_features, Random& random) {
  std::vector<Keypoint> keypoints(num_features);
  std::vector<Descriptor> descriptors(num_features);
  for (Keypoint& keypoint : keypoints) {
    keypoint.pixel = Eigen::Vector2d(random.Uniform(0, 640), random.Uniform(0, 480)).cast<float>();
    keypoint.octave = static_cast<std::int16_t>(random.Index(4));
    if (random.Index(3) != 0) {
      keypoint.right_x = keypoint.pixel.x() - static_cast<float>(random.Uniform(0, 40));
    }
  }
  for (Descriptor& descriptor : descriptors) descriptor = RandomDescriptor(random);
  return MakeFrame(keypoints, descriptors);
}

// Points near features, with descriptors near theirs, some of them wanting the same feature.
std::vector<ProjectedPoint> RandomPoints(const Frame& frame, int count, Random& random) {
  std::vector<ProjectedPoint> points(count);
  for (ProjectedPoint& point : points) {
    const auto feature = random.Index(static_cast<std::uint32_t>(frame.keypoints.size()));
    const Keypoint& keypoint = frame.keypoints[feature];
    point.pixel = keypoint.pixel +
                  Eigen::Vector2d(random.Uniform(-15, 15), random.Uniform(-15, 15)).cast<float>();
    point.right_x = random.Index(4) == 0 ? kNoRightX : point.pixel.x() - 20;
    point.radius = static_cast<float>(random.Uniform(5, 40));
    point.min_octave = std::max(0, keypoint.octave - 1);
    point.max_octave = keypoint.octave + static_cast<int>(random.Index(2));
    point.descriptor =
        Disturb(frame.descriptors[feature], static_cast<int>(random.Index(120)), random);
  }
  return points;
}

// What the header says, the slow way.
std::vector<FeatureMatch> MatchByBruteForce(const std::vector<ProjectedPoint>& points,
                                            const Frame& frame,
                                            const std::vector<std::uint8_t>& is_taken,
                                            const ProjectionMatchOptions& options) {
  std::map<int, FeatureMatch> best_of_feature;
  for (int query = 0; query < static_cast<int>(points.size()); ++query) {
    const ProjectedPoint& point = points[query];
    std::vector<std::pair<int, int>> candidates;  // Distance, feature.
    for (int i = 0; i < static_cast<int>(frame.keypoints.size()); ++i) {
      const Keypoint& keypoint = frame.keypoints[i];
      const Eigen::Vector2f offset = keypoint.pixel - point.pixel;
      if (!is_taken.empty() && is_taken[i] != 0) continue;
      if (offset.cwiseAbs().maxCoeff() > point.radius) continue;
      if (keypoint.octave < point.min_octave || keypoint.octave > point.max_octave) continue;
      if (point.right_x != kNoRightX && keypoint.right_x != kNoRightX &&
          std::abs(point.right_x - keypoint.right_x) > point.radius) {
        continue;
      }
      candidates.emplace_back(HammingDistance(point.descriptor, frame.descriptors[i]), i);
    }
    std::sort(candidates.begin(), candidates.end());
    if (candidates.empty() || candidates[0].first > options.max_distance) continue;
    const auto [distance, feature] = candidates[0];
    if (candidates.size() > 1 &&
        frame.keypoints[feature].octave == frame.keypoints[candidates[1].second].octave &&
        static_cast<float>(distance) >
            options.max_ratio * static_cast<float>(candidates[1].first)) {
      continue;
    }
    const auto [it, is_new] = best_of_feature.try_emplace(feature, FeatureMatch{});
    if (is_new || distance < it->second.distance) it->second = {query, feature, distance};
  }
  std::vector<FeatureMatch> matches;
  for (const auto& [feature, match] : best_of_feature) matches.push_back(match);
  std::sort(matches.begin(), matches.end(),
            [](const FeatureMatch& a, const FeatureMatch& b) { return a.query < b.query; });
  return matches;
}

TEST(ProjectionMatcherTest, FindsWhatBruteForceFinds) {
  Random random(11);
  std::size_t num_matches = 0;
  for (int round = 0; round < 20; ++round) {
    const Frame frame = RandomFrame(600, random);
    const std::vector<ProjectedPoint> points = RandomPoints(frame, 900, random);
    std::vector<std::uint8_t> is_taken(round % 2 == 0 ? 0 : frame.keypoints.size());
    for (std::uint8_t& taken : is_taken) taken = random.Index(3) == 0 ? 1 : 0;
    const ProjectionMatchOptions options{
        .max_distance = round % 3 == 0 ? kStrictHammingLimit : kLooseHammingLimit,
        .max_ratio = round % 4 == 0 ? 1.0F : 0.8F};
    const std::vector<FeatureMatch> matches =
        MatchProjectedPoints(points, frame, is_taken, options);
    ASSERT_EQ(matches, MatchByBruteForce(points, frame, is_taken, options)) << "round " << round;
    num_matches += matches.size();
  }
  EXPECT_GT(num_matches, 2000u) << "the test has too little to compare";
}

// A few features in one place, as many bits away from the point at hand as the test says.
class OneWindow : public ::testing::Test {
 protected:
  Descriptor BitsAway(int num_bits) const {
    Descriptor descriptor = base_;
    for (int bit = 0; bit < num_bits; ++bit) {
      descriptor.bits[bit / 64] ^= std::uint64_t{1} << (bit % 64);
    }
    return descriptor;
  }
  static Keypoint At(float x, float y, int octave = 0) {
    Keypoint keypoint;
    keypoint.pixel = {x, y};
    keypoint.octave = static_cast<std::int16_t>(octave);
    return keypoint;
  }
  ProjectedPoint Point(int num_bits = 0) const {
    ProjectedPoint point;
    point.pixel = {100, 100};
    point.radius = 10;
    point.max_octave = 7;
    point.descriptor = BitsAway(num_bits);
    return point;
  }

  Random random_{3};
  Descriptor base_ = RandomDescriptor(random_);
};

TEST_F(OneWindow, RefusesAMatchWithAnEquallyGoodSecond) {
  const Frame frame = MakeFrame({At(101, 100), At(99, 100)}, {BitsAway(40), BitsAway(45)});
  EXPECT_THAT(MatchProjectedPoints({{Point()}}, frame, {}, {.max_ratio = 0.8F}), IsEmpty());
  EXPECT_THAT(MatchProjectedPoints({{Point()}}, frame, {}, {.max_ratio = 1.0F}),
              ElementsAre(FeatureMatch{0, 0, 40}));
}

TEST_F(OneWindow, ASecondOnAnotherLevelIsNoRival) {
  const Frame frame = MakeFrame({At(101, 100, 2), At(99, 100, 3)}, {BitsAway(40), BitsAway(45)});
  EXPECT_THAT(MatchProjectedPoints({{Point()}}, frame, {}, {.max_ratio = 0.8F}),
              ElementsAre(FeatureMatch{0, 0, 40}));
}

TEST_F(OneWindow, ATakenFeatureIsNeitherFoundNorARival) {
  const Frame frame = MakeFrame({At(101, 100), At(99, 100)}, {BitsAway(40), BitsAway(45)});
  const std::vector<std::uint8_t> first_taken{1, 0};
  EXPECT_THAT(MatchProjectedPoints({{Point()}}, frame, first_taken, {.max_ratio = 0.8F}),
              ElementsAre(FeatureMatch{0, 1, 45}));
}

TEST_F(OneWindow, TheNearestDescriptorGetsAFeatureThatSeveralWant) {
  const Frame frame = MakeFrame({At(101, 100)}, {BitsAway(30)});
  const std::vector<ProjectedPoint> points{Point(0), Point(25), Point(10)};
  EXPECT_THAT(MatchProjectedPoints(points, frame, {}, {}), ElementsAre(FeatureMatch{1, 0, 5}));
}

TEST_F(OneWindow, TooManyBitsAreNoMatch) {
  const Frame frame = MakeFrame({At(101, 100)}, {BitsAway(51)});
  EXPECT_THAT(MatchProjectedPoints({{Point()}}, frame, {}, {.max_distance = 50}), IsEmpty());
  EXPECT_THAT(MatchProjectedPoints({{Point(1)}}, frame, {}, {.max_distance = 50}),
              ElementsAre(FeatureMatch{0, 0, 50}));
}

TEST_F(OneWindow, DepthMustAgreeWhereBothHaveIt) {
  Keypoint keypoint = At(101, 100);
  keypoint.right_x = 60;
  const Frame frame = MakeFrame({keypoint}, {BitsAway(3)});
  ProjectedPoint point = Point();
  point.right_x = 71;
  EXPECT_THAT(MatchProjectedPoints({{point}}, frame, {}, {}), IsEmpty());
  point.right_x = 69;
  EXPECT_THAT(MatchProjectedPoints({{point}}, frame, {}, {}), ElementsAre(FeatureMatch{0, 0, 3}));
  point.right_x = kNoRightX;
  EXPECT_THAT(MatchProjectedPoints({{point}}, frame, {}, {}), ElementsAre(FeatureMatch{0, 0, 3}));
}

TEST_F(OneWindow, AnEmptyFrameGivesNoMatch) {
  EXPECT_THAT(MatchProjectedPoints({{Point()}}, Frame(), {}, {}), IsEmpty());
  EXPECT_THAT(MatchProjectedPoints({}, MakeFrame({At(1, 1)}, {base_}), {}, {}), IsEmpty());
}

std::vector<FeatureMatch> Numbered(std::size_t count) {
  std::vector<FeatureMatch> matches;
  for (int i = 0; i < static_cast<int>(count); ++i) matches.push_back({i, i, 0});
  return matches;
}

TEST(KeepConsistentTurnsTest, DropsMatchesThatTurnOtherwise) {
  Random random(5);
  const float bin = 2 * std::numbers::pi_v<float> / 30;
  std::vector<float> turns;
  std::vector<FeatureMatch> expected;
  const std::vector<FeatureMatch> matches = Numbered(300);
  for (int i = 0; i < 300; ++i) {
    const bool is_good = i % 3 != 0;
    // The good ones in the middle of one bin, across the end of the circle; whole turns do not
    // matter. The others in bins 5 to 28, four in each.
    const float turn = is_good ? static_cast<float>(random.Uniform(-0.4, 0.4)) * bin
                               : bin * static_cast<float>(5 + (i / 3) % 24);
    const int whole_turns = static_cast<int>(random.Index(3)) - 1;
    turns.push_back(turn + static_cast<float>(whole_turns) * 2 * std::numbers::pi_v<float>);
    if (is_good) expected.push_back(matches[i]);
  }
  EXPECT_EQ(KeepConsistentTurns(matches, turns), expected);
}

TEST(KeepConsistentTurnsTest, KeepsTheThreeFullestOfThirtyBins) {
  const float bin = 2 * std::numbers::pi_v<float> / 30;
  const std::vector<std::pair<int, int>> fill{{3, 40}, {10, 30}, {17, 20}, {24, 15}};
  std::vector<float> turns;
  for (const auto& [number, count] : fill) {
    for (int i = 0; i < count; ++i) turns.push_back(bin * static_cast<float>(number));
  }
  const std::vector<FeatureMatch> matches = Numbered(turns.size());
  EXPECT_EQ(KeepConsistentTurns(matches, turns), Numbered(40 + 30 + 20));
}

TEST(KeepConsistentTurnsTest, NoMatchesGiveNone) {
  EXPECT_THAT(KeepConsistentTurns({}, {}), IsEmpty());
}

}  // namespace
}  // namespace semslam

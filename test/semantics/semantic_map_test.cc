// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/semantics/semantic_map.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "semslam/dense/voxel_map.h"

#include "dense/synthetic_depth.h"

namespace semslam {
namespace {

using testing::Box;
using testing::RenderBoxes;
using testing::TestCamera;

constexpr int kCup = 0;
constexpr int kMonitor = 1;
constexpr int kLaptop = 2;
constexpr int kTable = 3;

ClassTable Classes() { return ClassTable({"cup", "tvmonitor", "laptop", "dining table"}); }

// A desk before a wall, things on the desk, seen by keyframes from slightly different places. The
// segments are known from the geometry: 1 wall, 2 desk, 3.. the things.
class Desk {
 public:
  explicit Desk(const std::vector<Box>& things) : boxes_(things) {
    boxes_.insert(boxes_.begin(), {{-3, 0.3, 0.5}, {3, 0.35, 2.0}});
    boxes_.insert(boxes_.begin(), {{-3, -3, 2.0}, {3, 3, 2.1}});
  }

  void AddKeyframe(const Rigid3& T_world_camera, std::vector<Detection> detections) {
    const auto rays = std::make_shared<const RayTable>(TestCamera());
    const KeyframeId id{static_cast<std::uint32_t>(keyframes_.size())};
    const auto cloud =
        BuildKeyframeCloud(id, RenderBoxes(boxes_, TestCamera(), T_world_camera), rays, {});
    keyframes_.push_back({cloud, T_world_camera, std::move(detections)});
  }

  // The rectangle around a thing (3..) in a keyframe at a pose, `margin` pixels larger.
  ImageBox BoxAround(SegmentId thing, const Rigid3& T_world_camera, float margin) const {
    ImageBox box{1e9F, 1e9F, -1e9F, -1e9F};
    const Box& solid = boxes_[thing - 1];
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d p_world((corner & 1) != 0 ? solid.low.x() : solid.high.x(),
                                    (corner & 2) != 0 ? solid.low.y() : solid.high.y(),
                                    (corner & 4) != 0 ? solid.low.z() : solid.high.z());
      const Eigen::Vector2f pixel =
          TestCamera().Project(T_world_camera.Inverse() * p_world).cast<float>();
      box = {std::min(box.min_x, pixel.x() - margin), std::min(box.min_y, pixel.y() - margin),
             std::max(box.max_x, pixel.x() + margin), std::max(box.max_y, pixel.y() + margin)};
    }
    return box;
  }

  // All things are one segment, 3;
  void JoinThings() { num_segments_ = 3; }
  // or no segments of their own, but the desk's, 2.
  void JoinThingsToTheDesk() { num_segments_ = 2; }

  SemanticMap Fuse(const FusionOptions& options = {}, const SemanticMap* previous = nullptr) {
    VoxelMap voxels({});
    for (const LabelledKeyframe& keyframe : keyframes_) {
      voxels.Integrate(keyframe.cloud, keyframe.T_world_camera);
    }
    cloud_ = voxels.Extract();
    const VoxelIndex index(cloud_.positions, cloud_.voxel_size);
    return BuildSemanticMap(cloud_, index, SegmentByGeometry(), keyframes_, Classes(), options,
                            previous);
  }

  std::set<int> ClassesOf(const SemanticMap& map, SegmentId segment) const {
    std::set<int> classes;
    for (std::size_t i = 0; i < map.segment_of_point.size(); ++i) {
      if (map.segment_of_point[i] == segment) classes.insert(map.class_of_point[i]);
    }
    return classes;
  }

  std::vector<LabelledKeyframe>& keyframes() { return keyframes_; }
  const MapCloud& cloud() const { return cloud_; }  // Of the last Fuse.
  const std::vector<Box>& boxes() const { return boxes_; }

 private:
  SegmentId SegmentAt(const Eigen::Vector3d& p_world) const {
    for (std::size_t i = boxes_.size(); i-- > 0;) {
      const Eigen::Vector3d outside = (boxes_[i].low - p_world).cwiseMax(p_world - boxes_[i].high);
      if (outside.maxCoeff() < 0.006) {
        return static_cast<SegmentId>(std::min(i + 1, num_segments_));
      }
    }
    return 0;
  }

  Segmentation SegmentByGeometry() const {
    Segmentation segmentation;
    segmentation.voxel_size = cloud_.voxel_size;
    std::vector<std::vector<Eigen::Vector3d>> points(boxes_.size());
    for (const Eigen::Vector3f& position : cloud_.positions) {
      const SegmentId segment = SegmentAt(position.cast<double>());
      segmentation.segment_of_point.push_back(segment);
      if (segment != 0) points[segment - 1].push_back(position.cast<double>());
    }
    for (std::size_t i = 0; i < std::min(boxes_.size(), num_segments_); ++i) {
      Segment segment;
      segment.id = static_cast<SegmentId>(i + 1);
      segment.num_points = points[i].size();
      segment.box = FitOrientedBox(points[i]);
      segment.area = static_cast<double>(points[i].size()) * 0.008 * 0.008;
      segment.is_structural = i < 2;
      segmentation.segments.push_back(segment);
    }
    return segmentation;
  }

  std::vector<Box> boxes_;
  std::size_t num_segments_ = 1000;
  std::vector<LabelledKeyframe> keyframes_;
  MapCloud cloud_;
};

Rigid3 ViewFrom(int number) {
  return {ExpSO3({0.15, -0.03 * number, 0}), {0.04 * number, -0.15, 0}};
}

const Box kCupBox{{-0.1, 0.1, 1.0}, {0.1, 0.3, 1.2}};

Detection Seen(int class_id, float score, const ImageBox& box) {
  Detection detection{class_id, score, box, std::vector<float>(4, 0.0F)};
  detection.class_scores[static_cast<std::size_t>(class_id)] = score;
  return detection;
}

TEST(BuildSemanticMap, LabelsOnlyTheThingAndNotWhatElseIsInTheBox) {
  Desk desk({kCupBox});
  for (int i = 0; i < 4; ++i) {
    desk.AddKeyframe(ViewFrom(i), {Seen(kCup, 0.7F, desk.BoxAround(3, ViewFrom(i), 15))});
  }
  const SemanticMap map = desk.Fuse();
  EXPECT_EQ(desk.ClassesOf(map, 1), std::set<int>{kNoClass});
  EXPECT_EQ(desk.ClassesOf(map, 2), std::set<int>{kNoClass});
  EXPECT_EQ(desk.ClassesOf(map, 3), std::set<int>{kCup});
  ASSERT_EQ(map.objects.size(), 1U);
  const SemanticObject& cup = map.objects[0];
  EXPECT_EQ(cup.class_id, kCup);
  EXPECT_EQ(cup.num_views, 4U);
  EXPECT_EQ(cup.id, 1U);
  EXPECT_GT(cup.confidence, 0.75) << "all evidence is for it, but of three views only";
  // Only the sides that were seen have points.
  EXPECT_LT((cup.centroid - Eigen::Vector3d(0, 0.2, 1.1)).cwiseAbs().maxCoeff(), 0.11);
  EXPECT_EQ(static_cast<std::size_t>(
                std::count(map.object_of_point.begin(), map.object_of_point.end(), cup.id)),
            cup.num_points);
}

TEST(BuildSemanticMap, NeverGivesTheDeskTheClassOfAThing) {
  Desk desk({});
  for (int i = 0; i < 4; ++i) {
    desk.AddKeyframe(ViewFrom(i), {Seen(kCup, 0.9F, {0, 0, 320, 240}),
                                   Seen(kMonitor, 0.9F, {0, 120, 320, 240})});
  }
  EXPECT_TRUE(desk.Fuse().objects.empty());
}

TEST(BuildSemanticMap, LetsALargePlaneBeATable) {
  Desk desk({});
  for (int i = 0; i < 4; ++i) {
    // Straight down on a part of the desk that is small enough.
    const Rigid3 pose{ExpSO3({-1.5708, 0, 0}) * ExpSO3({0, 0, 0.1 * i}), {0, -0.9, 1.3}};
    desk.AddKeyframe(pose, {Seen(kTable, 0.9F, {0, 0, 320, 240})});
  }
  const SemanticMap map = desk.Fuse();
  ASSERT_EQ(map.objects.size(), 1U);
  EXPECT_EQ(map.objects[0].class_id, kTable);
}

TEST(BuildSemanticMap, LeavesOutAThingBehindTheObjectInTheSameBox) {
  // The second thing looks out on both sides of the first, 40 cm behind it.
  Desk desk({kCupBox, {{-0.19, 0.1, 1.6}, {0.19, 0.28, 1.7}}});
  for (int i = 0; i < 4; ++i) {
    const Rigid3 pose = ViewFrom(0);
    desk.AddKeyframe(pose, {Seen(kMonitor, 0.7F, desk.BoxAround(3, pose, 12))});
  }
  const SemanticMap map = desk.Fuse();
  EXPECT_EQ(desk.ClassesOf(map, 3), std::set<int>{kMonitor});
  EXPECT_EQ(desk.ClassesOf(map, 4), std::set<int>{kNoClass});
}

TEST(BuildSemanticMap, RefusesSegmentsLargerThanTheClass) {
  Desk desk({{{-0.3, -0.1, 1.2}, {0.3, 0.3, 1.3}}});  // 60 cm.
  for (int i = 0; i < 3; ++i) {
    desk.AddKeyframe(ViewFrom(i), {Seen(kCup, 0.9F, desk.BoxAround(3, ViewFrom(i), 5))});
  }
  EXPECT_TRUE(desk.Fuse().objects.empty());
}

TEST(BuildSemanticMap, CountsViewsWithoutADetectionAgainstAThing) {
  const auto fuse = [](int num_detected) {
    Desk desk({kCupBox});
    for (int i = 0; i < 8; ++i) {
      std::vector<Detection> detections;
      if (i < num_detected) {
        detections.push_back(Seen(kCup, 0.4F, desk.BoxAround(3, ViewFrom(i % 4), 8)));
      }
      desk.AddKeyframe(ViewFrom(i % 4), detections);
    }
    return desk.Fuse();
  };
  EXPECT_EQ(fuse(2).objects.size(), 0U);
  EXPECT_EQ(fuse(7).objects.size(), 1U);
}

TEST(BuildSemanticMap, CountsAViewWithoutADetectionLessIfTheThingIsSmallInIt) {
  const auto fuse = [](const Box& cup) {
    Desk desk({cup});
    for (int i = 0; i < 14; ++i) {
      const Rigid3 pose = ViewFrom(i % 5);
      std::vector<Detection> detections;
      if (i < 3) detections.push_back(Seen(kCup, 0.5F, desk.BoxAround(3, pose, 3)));
      desk.AddKeyframe(pose, detections);
    }
    return desk.Fuse();
  };
  EXPECT_EQ(fuse(kCupBox).objects.size(), 0U) << "52 pixels of 320";
  EXPECT_EQ(fuse({{-0.04, 0.22, 1.4}, {0.04, 0.3, 1.48}}).objects.size(), 1U) << "15 pixels";
}

TEST(BuildSemanticMap, NeedsTwoViewsOfWhatManySaw) {
  Desk desk({kCupBox});
  desk.AddKeyframe(ViewFrom(0), {Seen(kCup, 1.0F, desk.BoxAround(3, ViewFrom(0), 8))});
  desk.AddKeyframe(ViewFrom(1), {});
  EXPECT_TRUE(desk.Fuse().objects.empty());
}

TEST(BuildSemanticMap, BelievesTheOnlyViewIfItIsSure) {
  for (const auto& [score, expected] : {std::pair{0.9F, 1U}, {0.4F, 0U}}) {
    Desk desk({kCupBox});
    desk.AddKeyframe(ViewFrom(0), {Seen(kCup, score, desk.BoxAround(3, ViewFrom(0), 8))});
    EXPECT_EQ(desk.Fuse().objects.size(), expected) << score;
  }
}

TEST(BuildSemanticMap, TellsBackgroundFromUnknown) {
  const auto judge_after = [](int num_views) {
    Desk desk({kCupBox});
    for (int i = 0; i < num_views; ++i) desk.AddKeyframe(ViewFrom(i % 4), {});
    FusionOptions options;
    options.evidence.sure_size = 0.05;
    const SemanticMap map = desk.Fuse(options);
    const auto cup = std::find(map.segment_of_point.begin(), map.segment_of_point.end(), 3U) -
                     map.segment_of_point.begin();
    return std::pair(map.confidence_of_point[static_cast<std::size_t>(cup)],
                     map.entropy_of_point[static_cast<std::size_t>(cup)]);
  };
  const auto [little_confidence, much_entropy] = judge_after(1);
  EXPECT_EQ(little_confidence, 0) << "unknown";
  const auto [confidence, entropy] = judge_after(12);
  EXPECT_NEAR(confidence, 2.4 / 3.0, 1e-4) << "12 views of 0.2 against 0.6";
  EXPECT_LT(entropy, much_entropy);
}

TEST(BuildSemanticMap, AveragesTheDistributionOfConfusedClasses) {
  Desk desk({{{-0.2, 0.0, 1.2}, {0.2, 0.3, 1.25}}});
  for (int i = 0; i < 4; ++i) {
    // The laptop is first more often, the monitor has more evidence.
    Detection detection = Seen(kLaptop, 0.5F, desk.BoxAround(3, ViewFrom(i), 6));
    detection.class_scores[kMonitor] = 0.45F;
    if (i == 3) detection = Seen(kMonitor, 0.9F, detection.box);
    if (i == 2) detection.class_id = kMonitor;
    desk.AddKeyframe(ViewFrom(i), {detection});
  }
  const SemanticMap map = desk.Fuse();
  ASSERT_EQ(map.objects.size(), 1U);
  EXPECT_EQ(map.objects[0].class_id, kMonitor);
  EXPECT_LT(map.objects[0].confidence, 0.7);
}

TEST(BuildSemanticMap, JoinsTheHalvesOfAnOverSegmentedThing) {
  Desk desk({{{-0.2, 0.0, 1.2}, {0.0, 0.3, 1.3}}, {{0.0, 0.0, 1.2}, {0.2, 0.3, 1.3}}});
  for (int i = 0; i < 3; ++i) {
    const ImageBox left = desk.BoxAround(3, ViewFrom(i), 6);
    const ImageBox right = desk.BoxAround(4, ViewFrom(i), 6);
    const ImageBox both{left.min_x, std::min(left.min_y, right.min_y), right.max_x,
                        std::max(left.max_y, right.max_y)};
    desk.AddKeyframe(ViewFrom(i), {Seen(kMonitor, 0.8F, both)});
  }
  const SemanticMap map = desk.Fuse();
  ASSERT_EQ(map.objects.size(), 1U);
  EXPECT_EQ(map.objects[0].segments, (std::vector<SegmentId>{3, 4}));
}

TEST(BuildSemanticMap, KeepsTwoThingsOfOneClassApart) {
  Desk desk({{{-0.22, 0.0, 1.2}, {-0.01, 0.3, 1.3}}, {{0.01, 0.0, 1.2}, {0.22, 0.3, 1.3}}});
  for (int i = 0; i < 3; ++i) {
    desk.AddKeyframe(ViewFrom(i), {Seen(kMonitor, 0.8F, desk.BoxAround(3, ViewFrom(i), 3)),
                                   Seen(kMonitor, 0.8F, desk.BoxAround(4, ViewFrom(i), 3))});
  }
  EXPECT_EQ(desk.Fuse().objects.size(), 2U);
}

const Box kLeft{{-0.32, 0.1, 1.2}, {-0.11, 0.3, 1.3}};
const Box kMiddle{{-0.11, 0.1, 1.2}, {0.1, 0.3, 1.3}};
const Box kRight{{0.1, 0.1, 1.2}, {0.31, 0.3, 1.3}};

// Things that touch and are one segment, a box around each of `classes`.
Desk TouchingThings(const std::vector<Box>& things, const std::vector<int>& classes) {
  Desk desk(things);
  for (int i = 0; i < 4; ++i) {
    std::vector<Detection> detections;
    for (std::size_t k = 0; k < classes.size(); ++k) {
      const auto thing = static_cast<SegmentId>(3 + k);
      detections.push_back(Seen(classes[k], 0.8F, desk.BoxAround(thing, ViewFrom(i), 1)));
    }
    desk.AddKeyframe(ViewFrom(i), detections);
  }
  desk.JoinThings();
  return desk;
}

// The share of an object's points that are on a thing.
double ShareOn(const Box& thing, const SemanticMap& map, const SemanticObject& object, Desk& desk) {
  double num_on = 0;
  for (std::size_t i = 0; i < map.object_of_point.size(); ++i) {
    if (map.object_of_point[i] != object.id) continue;
    const float x = desk.cloud().positions[i].x();
    if (x > thing.low.x() - 0.005 && x < thing.high.x() + 0.005) ++num_on;
  }
  return num_on / static_cast<double>(object.num_points);
}

TEST(BuildSemanticMap, PartsASegmentThatHoldsThingsOfTwoClasses) {
  Desk desk = TouchingThings({kLeft, kMiddle}, {kLaptop, kMonitor});
  const SemanticMap map = desk.Fuse();
  ASSERT_EQ(map.objects.size(), 2U);
  for (const SemanticObject& object : map.objects) {
    const Box& thing = object.class_id == kLaptop ? kLeft : kMiddle;
    EXPECT_GT(ShareOn(thing, map, object, desk), 0.95) << object.class_id;
    EXPECT_GT(object.num_points, 300U);
  }
  EXPECT_NE(map.objects[0].class_id, map.objects[1].class_id);
  EXPECT_EQ(map.objects[0].segments, std::vector<SegmentId>{3});
  EXPECT_EQ(map.objects[1].segments, std::vector<SegmentId>{4}) << "a new number";
}

TEST(BuildSemanticMap, PartsASegmentThatHoldsThreeThingsOfOneClass) {
  Desk desk = TouchingThings({kLeft, kMiddle, kRight}, {kMonitor, kMonitor, kMonitor});
  const SemanticMap map = desk.Fuse();
  ASSERT_EQ(map.objects.size(), 3U);
  std::set<const Box*> found;
  for (const SemanticObject& object : map.objects) {
    for (const Box* thing : {&kLeft, &kMiddle, &kRight}) {
      if (ShareOn(*thing, map, object, desk) > 0.9) found.insert(thing);
    }
  }
  EXPECT_EQ(found.size(), 3U);
  std::reverse(desk.keyframes().begin(), desk.keyframes().end());
  for (LabelledKeyframe& keyframe : desk.keyframes()) {
    std::reverse(keyframe.detections.begin(), keyframe.detections.end());
  }
  EXPECT_EQ(desk.Fuse().segment_of_point, map.segment_of_point);
}

TEST(BuildSemanticMap, LeavesAThingWholeThatHasLabelsOnIt) {
  Desk desk({{{-0.32, 0.0, 1.2}, {0.32, 0.3, 1.3}}});
  for (int i = 0; i < 4; ++i) {
    const ImageBox all = desk.BoxAround(3, ViewFrom(i), 4);
    const ImageBox left{all.min_x, all.min_y, all.min_x + 0.25F * all.width(), all.max_y};
    const ImageBox right{all.max_x - 0.25F * all.width(), all.min_y, all.max_x, all.max_y};
    desk.AddKeyframe(ViewFrom(i), {Seen(kCup, 0.8F, left), Seen(kCup, 0.8F, right)});
  }
  const SemanticMap map = desk.Fuse();
  EXPECT_EQ(*std::max_element(map.segment_of_point.begin(), map.segment_of_point.end()), 3U);
}

TEST(BuildSemanticMap, DoesNotPartAThingThatIsSeenWholeInMostViews) {
  Desk desk = TouchingThings({kLeft, kMiddle}, {kLaptop, kLaptop});
  for (int i = 0; i < 12; ++i) {
    const ImageBox left = desk.BoxAround(3, ViewFrom(i % 4), 4);
    const ImageBox right = desk.BoxAround(4, ViewFrom(i % 4), 4);
    desk.AddKeyframe(ViewFrom(i % 4), {Seen(kMonitor, 0.8F,
                                            {left.min_x, std::min(left.min_y, right.min_y),
                                             right.max_x, std::max(left.max_y, right.max_y)})});
  }
  const SemanticMap map = desk.Fuse();
  ASSERT_EQ(map.objects.size(), 1U);
  EXPECT_EQ(map.objects[0].class_id, kMonitor);
}

// Something flat that is one segment with the desk, in a loose box.
Desk FlatThingOnTheDesk(const Box& thing) {
  Desk desk({thing});
  for (int i = 0; i < 5; ++i) {
    desk.AddKeyframe(ViewFrom(i), {Seen(kLaptop, 0.8F, desk.BoxAround(3, ViewFrom(i), 6))});
  }
  desk.JoinThingsToTheDesk();
  return desk;
}

TEST(BuildSemanticMap, TakesAFlatThingOutOfTheDeskItIsOneSegmentWith) {
  const Box thing{{-0.22, 0.275, 1.65}, {0.22, 0.3, 1.8}};
  Desk desk = FlatThingOnTheDesk(thing);
  const SemanticMap map = desk.Fuse();
  ASSERT_EQ(map.objects.size(), 1U);
  EXPECT_EQ(map.objects[0].class_id, kLaptop);
  EXPECT_EQ(map.objects[0].segments, std::vector<SegmentId>{3}) << "a new number";
  std::size_t num_on = 0;
  std::size_t num_labelled = 0;
  std::size_t num_both = 0;
  for (std::size_t i = 0; i < map.object_of_point.size(); ++i) {
    const Eigen::Vector3d p = desk.cloud().positions[i].cast<double>();
    const bool is_on = (thing.low - p).maxCoeff() < 0.002 && (p - thing.high).maxCoeff() < -0.005;
    if (is_on) ++num_on;
    if (map.object_of_point[i] != 0) ++num_labelled;
    if (is_on && map.object_of_point[i] != 0) ++num_both;
  }
  EXPECT_GT(num_on, 200U);
  EXPECT_GT(num_both, 0.85 * static_cast<double>(num_on));
  EXPECT_LT(num_labelled, 1.15 * static_cast<double>(num_on)) << "no class on the desk top";
}

TEST(BuildSemanticMap, TakesNothingAlongThatOnlyOneBoxHolds) {
  Desk desk({{{-0.22, 0.275, 1.65}, {0.1, 0.3, 1.8}}, {{0.12, 0.275, 1.65}, {0.3, 0.3, 1.8}}});
  for (int i = 0; i < 3; ++i) {
    desk.AddKeyframe(ViewFrom(i), {Seen(kLaptop, 0.8F, desk.BoxAround(3, ViewFrom(i), 3))});
  }
  ImageBox both = desk.BoxAround(3, ViewFrom(3), 3);
  both.max_x = desk.BoxAround(4, ViewFrom(3), 3).max_x;
  desk.AddKeyframe(ViewFrom(3), {Seen(kLaptop, 0.8F, both)});
  desk.JoinThingsToTheDesk();
  const SemanticMap map = desk.Fuse();
  ASSERT_EQ(map.objects.size(), 1U);
  const OrientedBox& box = map.objects[0].box;
  EXPECT_NEAR(2 * box.half_size.maxCoeff(), 0.32, 0.04);
}

TEST(BuildSemanticMap, TakesNothingOutOfTheDeskThatDoesNotRiseAboveIt) {
  Desk desk = FlatThingOnTheDesk({{-0.22, 0.299, 1.65}, {0.22, 0.3, 1.8}});
  const SemanticMap map = desk.Fuse();
  EXPECT_TRUE(map.objects.empty()) << "a picture of a laptop";
  EXPECT_EQ(*std::max_element(map.segment_of_point.begin(), map.segment_of_point.end()), 2U);
}

TEST(BuildSemanticMap, DoesNotDependOnTheOrderOfKeyframes) {
  Desk desk({kCupBox, {{0.3, 0.0, 1.2}, {0.6, 0.3, 1.3}}});
  for (int i = 0; i < 4; ++i) {
    Detection confused =
        Seen(kLaptop, 0.3F + 0.07F * static_cast<float>(i), desk.BoxAround(4, ViewFrom(i), 7));
    confused.class_scores[kMonitor] = 0.29F;
    desk.AddKeyframe(ViewFrom(i), {Seen(kCup, 0.63F, desk.BoxAround(3, ViewFrom(i), 9)), confused});
  }
  const SemanticMap forward = desk.Fuse();
  std::reverse(desk.keyframes().begin(), desk.keyframes().end());
  const SemanticMap backward = desk.Fuse();
  ASSERT_EQ(forward.objects.size(), 2U);
  EXPECT_EQ(forward.class_of_point, backward.class_of_point);
  EXPECT_EQ(forward.confidence_of_point, backward.confidence_of_point);
  EXPECT_EQ(forward.object_of_point, backward.object_of_point);
}

TEST(BuildSemanticMap, IgnoresNonsenseFromTheDetector) {
  Desk desk({kCupBox});
  for (int i = 0; i < 3; ++i) {
    const ImageBox box = desk.BoxAround(3, ViewFrom(i), 9);
    Detection nan_score = Seen(kMonitor, std::nanf(""), box);
    Detection unknown = Seen(kMonitor, 0.9F, box);
    unknown.class_id = 99;
    Detection short_scores = Seen(kMonitor, 0.9F, box);
    short_scores.class_scores.resize(1);
    desk.AddKeyframe(ViewFrom(i),
                     {nan_score, unknown, short_scores,
                      Seen(kMonitor, 0.9F, {-900, -900, -800, -800}), Seen(kCup, 0.6F, box)});
  }
  const SemanticMap map = desk.Fuse();
  ASSERT_EQ(map.objects.size(), 1U);
  EXPECT_EQ(map.objects[0].class_id, kCup);
}

TEST(BuildSemanticMap, KeepsTheIdsOfObjectsFoundAgain) {
  const Box second{{0.3, 0.1, 1.0}, {0.45, 0.3, 1.15}};
  Desk before({second});
  for (int i = 0; i < 3; ++i) {
    before.AddKeyframe(ViewFrom(i), {Seen(kCup, 0.7F, before.BoxAround(3, ViewFrom(i), 6))});
  }
  const SemanticMap first_map = before.Fuse();
  ASSERT_EQ(first_map.objects.size(), 1U);

  Desk after({kCupBox, second});
  for (int i = 0; i < 3; ++i) {
    after.AddKeyframe(ViewFrom(i), {Seen(kCup, 0.7F, after.BoxAround(3, ViewFrom(i), 6)),
                                    Seen(kCup, 0.7F, after.BoxAround(4, ViewFrom(i), 6))});
  }
  const SemanticMap map = after.Fuse({}, &first_map);
  ASSERT_EQ(map.objects.size(), 2U);
  EXPECT_EQ(map.objects[0].segments, std::vector<SegmentId>{4});  // Was there before.
  EXPECT_EQ(map.objects[1].segments, std::vector<SegmentId>{3});
  EXPECT_EQ(map.next_object_id, 3U);
}

TEST(BuildSemanticMap, WithoutDetectionsHasSegmentsOnly) {
  Desk desk({kCupBox});
  desk.AddKeyframe(ViewFrom(0), {});
  const SemanticMap map = desk.Fuse();
  EXPECT_TRUE(map.objects.empty());
  EXPECT_EQ(desk.ClassesOf(map, 3), std::set<int>{kNoClass});
  EXPECT_EQ(map.object_of_point.size(), map.segment_of_point.size());
  const SemanticMap empty = BuildSemanticMap({}, VoxelIndex(), {}, {}, Classes(), {});
  EXPECT_TRUE(empty.class_of_point.empty());
}

}  // namespace
}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/viewer/map_scene.h"

#include <set>
#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace semslam {
namespace {

using ::testing::ElementsAre;
using ::testing::Optional;

const std::vector<ClassRecord> kClasses = {{1, "cup", {255, 0, 0}}, {2, "mouse", {0, 0, 255}}};
const Eigen::Vector3d kUp(0, -1, 0);

ObjectRecord MakeObject(std::uint32_t id, std::uint32_t label, const Eigen::Vector3d& center) {
  ObjectRecord object;
  object.id = id;
  object.label = label;
  object.confidence = 0.876;
  object.centroid = center;
  object.box = {{Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY())), center},
                Eigen::Vector3d(0.1, 0.1, 0.1)};
  return object;
}

// Three points, one above the other.
struct ThreePoints {
  std::vector<Eigen::Vector3f> positions = {{0, 0, 1}, {0, -0.5F, 1}, {0, -1, 1}};
  std::vector<Rgb> colors = {{10, 20, 30}, {40, 50, 60}, {70, 80, 90}};
  std::vector<std::uint32_t> labels = {0, 1, 2};
  std::vector<std::uint32_t> segments = {1, 1, 2};
  LabelledMapView View() const {
    LabelledMapView view;
    view.cloud = {.positions = positions, .colors = colors, .labels = labels, .segments = segments};
    view.classes = kClasses;
    return view;
  }
};

TEST(PointColorsTest, PhotosAreAsTheyWereTaken) {
  const ThreePoints points;
  EXPECT_EQ(PointColors(points.View(), ColorMode::kPhoto, kUp, {}), points.colors);
}

TEST(PointColorsTest, SegmentsHaveColoursOfTheirOwn) {
  const ThreePoints points;
  const std::vector<Rgb> colors = PointColors(points.View(), ColorMode::kSegments, kUp, {});
  EXPECT_EQ(colors[0], colors[1]);
  EXPECT_NE(colors[1], colors[2]);
}

TEST(PointColorsTest, ClassesHaveTheColoursOfTheTableAndTheRestIsGrey) {
  const ThreePoints points;
  const std::vector<Rgb> colors = PointColors(points.View(), ColorMode::kClasses, kUp, {});
  EXPECT_EQ(colors[1], (Rgb{255, 0, 0}));
  EXPECT_EQ(colors[2], (Rgb{0, 0, 255}));
  EXPECT_EQ(colors[0].r, colors[0].g);
}

TEST(PointColorsTest, HeightsGoFromTheLowestColourToTheHighest) {
  const ThreePoints points;
  const HeightRange heights{0, 1};
  EXPECT_THAT(PointColors(points.View(), ColorMode::kHeight, kUp, heights),
              ElementsAre(HeightColor(0), HeightColor(0.5), HeightColor(1)));
}

TEST(PointColorsTest, ACloudOfPositionsAloneHasColoursInEveryMode) {
  const ThreePoints points;
  LabelledMapView view;
  view.cloud.positions = points.positions;
  for (const ColorMode mode :
       {ColorMode::kPhoto, ColorMode::kSegments, ColorMode::kClasses, ColorMode::kHeight})
    EXPECT_EQ(PointColors(view, mode, kUp, {0, 1}).size(), 3U);
}

TEST(HeightColorTest, LeavesNoGapAndIsClampedAtItsEnds) {
  EXPECT_EQ(HeightColor(-3), HeightColor(0));
  EXPECT_EQ(HeightColor(7), HeightColor(1));
  for (int i = 0; i < 100; ++i) {
    const Rgb a = HeightColor(0.01 * i);
    const Rgb b = HeightColor(0.01 * (i + 1));
    EXPECT_LE(std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b), 15) << i;
  }
}

TEST(HeightRangeTest, IgnoresTheFewPointsFarFromTheRest) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 1000; ++i) points.emplace_back(0, -0.001F * static_cast<float>(i), 0);
  points.emplace_back(0, -100, 0);
  points.emplace_back(0, 100, 0);
  const HeightRange range = FindHeightRange(points, kUp);
  EXPECT_NEAR(range.low, 0, 0.02);
  EXPECT_NEAR(range.high, 1, 0.02);
}

TEST(PickObjectTest, TakesTheNearestBoxOnTheRay) {
  const std::vector<ObjectRecord> objects = {MakeObject(4, 1, {0, 0, 3}),
                                             MakeObject(7, 2, {0, 0, 2})};
  EXPECT_THAT(PickObject(objects, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()), Optional(7U));
}

TEST(PickObjectTest, ABoxBehindTheEyeOrBesideTheRayIsNotMeant) {
  const std::vector<ObjectRecord> objects = {MakeObject(4, 1, {0, 0, -3}),
                                             MakeObject(7, 2, {0.5, 0, 2})};
  EXPECT_EQ(PickObject(objects, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()), std::nullopt);
}

TEST(ObjectTitleTest, TellsClassAndConfidence) {
  EXPECT_EQ(ObjectTitle(MakeObject(1, 2, {0, 0, 1}), kClasses), "mouse 88 %");
  EXPECT_EQ(ObjectTitle(MakeObject(1, 9, {0, 0, 1}), kClasses), "object 88 %");
}

TEST(MakeOverlayTest, ShowsOnlyWhatIsAskedFor) {
  const ThreePoints points;
  MapScene scene;
  scene.map = points.View();
  scene.map.objects = {MakeObject(1, 1, {0, 0, 1})};
  scene.trajectory = {{0, {}}, {kNsPerSecond / 30, {Eigen::Quaterniond::Identity(), {0.1, 0, 0}}}};
  const auto overlay = [&](bool grid, bool trajectory, bool objects) {
    OverlayOptions options;
    options.grid = grid;
    options.trajectory = trajectory;
    options.objects = objects;
    return MakeOverlay(scene, LevelFrame(), options);
  };
  EXPECT_TRUE(overlay(false, false, false).lines().empty());
  EXPECT_EQ(overlay(false, true, false).lines().size(), 1U);
  EXPECT_EQ(overlay(false, false, true).lines().size(), 12U);
  EXPECT_EQ(overlay(false, false, true).labels().size(), 1U);
  EXPECT_GT(overlay(true, false, false).lines().size(), 20U);
}

TEST(MakeOverlayTest, TheTrajectoryHasAGapWhereTheCameraWasLost) {
  MapScene scene;
  scene.trajectory = {{0, {}}, {3 * kNsPerSecond, {Eigen::Quaterniond::Identity(), {1, 0, 0}}}};
  EXPECT_TRUE(MakeOverlay(scene, LevelFrame(), {}).lines().empty());
}

TEST(DrawListTest, ABoxHasTheTwelveEdgesOfItsCorners) {
  DrawList list;
  const OrientedBox box{{Eigen::Quaterniond::Identity(), {1, 2, 3}}, {0.5, 1, 2}};
  list.AddBox(box, {});
  ASSERT_EQ(list.lines().size(), 12U);
  std::multiset<float> lengths;
  for (const DrawList::Line& line : list.lines()) {
    lengths.insert((line.a - line.b).norm());
    for (const Eigen::Vector3f& end : {line.a, line.b}) {
      const Eigen::Array3f share =
          (end - Eigen::Vector3f(1, 2, 3)).array() / Eigen::Array3f(0.5F, 1, 2);
      EXPECT_TRUE((share.abs() - 1).abs().maxCoeff() < 1e-6F) << end.transpose();
    }
  }
  EXPECT_EQ(lengths.count(1), 4U);
  EXPECT_EQ(lengths.count(2), 4U);
  EXPECT_EQ(lengths.count(4), 4U);
}

TEST(DrawListTest, AFrustumStartsAtTheCameraAndOpensForwards) {
  DrawList list;
  const Rigid3 T_world_camera{Eigen::Quaterniond::Identity(), {1, 0, 0}};
  list.AddFrustum(T_world_camera, 0.5, 0.4, 0.2, {});
  int num_at_camera = 0;
  for (const DrawList::Line& line : list.lines()) {
    if (line.a == Eigen::Vector3f(1, 0, 0)) ++num_at_camera;
    EXPECT_NEAR(line.b.z(), 0.2, 1e-6);
  }
  EXPECT_EQ(num_at_camera, 4);
}

}  // namespace
}  // namespace semslam

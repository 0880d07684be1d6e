// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/scene_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "semslam/render/scenes.h"

#include "render/object_catalog.h"
#include "support/files.h"

namespace semslam {
namespace {

using testing::InputErrorOf;

constexpr char kCamera[] =
    "camera:\n"
    "  waypoints: [{eye: [0, -3, 1], target: [0, 0, 1]}, {eye: [1, -3, 1], target: [0, 0, 1]}]\n";

// A scene of the given objects, which start at line 2.
std::string WithObjects(const std::string& objects) { return "objects:\n" + objects + kCamera; }

StagedScene Parsed(const std::string& text, std::uint64_t seed = 1) {
  return ParseScene(text, "my.yaml", seed);
}

const OrientedBox& BoxOf(const StagedScene& staged, std::size_t index) {
  return staged.scene.instances().at(index).box;
}

TEST(SceneFile, APrimitiveStandsWhereItIsSaid) {
  const StagedScene staged =
      Parsed(WithObjects("  - {shape: box, class: crate, size: [1, 2, 0.5], material: '#808080', "
                         "at: [3, 4], yaw: 90}\n"));
  EXPECT_EQ(staged.scene.instances()[0].class_name, "crate");
  const OrientedBox& box = BoxOf(staged, 0);
  EXPECT_LT((box.T_world_box.translation - Eigen::Vector3d(3, 4, 0.25)).norm(), 1e-6);
  EXPECT_LT((box.half_size - Eigen::Vector3d(0.5, 1, 0.25)).norm(), 1e-6);
  EXPECT_NEAR((box.T_world_box.rotation * Eigen::Vector3d::UnitX()).y(), 1, 1e-6);
}

TEST(SceneFile, AThingOnAnotherTouchesItAndTurnsWithIt) {
  const StagedScene staged = Parsed(
      WithObjects("  - {shape: box, name: low, class: a, size: [1, 1, 0.5], material: '#808080', "
                  "at: [3, 0], yaw: 90}\n"
                  "  - {shape: sphere, class: b, radius: 0.1, material: '#808080', on: low, at: "
                  "[0.2, 0]}\n"));
  EXPECT_LT((BoxOf(staged, 1).T_world_box.translation - Eigen::Vector3d(3, 0.2, 0.6)).norm(), 1e-6);
}

TEST(SceneFile, ATiltedThingStillStandsOnItsLowestPoint) {
  const StagedScene staged = Parsed(WithObjects(
      "  - {shape: box, class: a, size: [0.2, 0.2, 1], material: '#808080', pitch: 45}\n"));
  const double reach = 0.5 * (0.2 + 1) * std::sqrt(0.5);  // Half the height of the tilted box.
  EXPECT_NEAR(BoxOf(staged, 0).T_world_box.translation.z(), reach, 1e-6);
}

TEST(SceneFile, WhatHangsAtAWallIsBeforeItsFace) {
  const StagedScene staged =
      Parsed(WithObjects("  - {object: wall, name: w, size: [4, 3], at: [1, 2]}\n"
                         "  - {object: poster, size: [0.5, 0.5], hang: w, at: [0.5, 1.5]}\n"));
  const OrientedBox& box = BoxOf(staged, 1);
  const double back = box.T_world_box.translation.y() + box.half_size.y();
  EXPECT_LT(back, 2);
  EXPECT_GT(back, 2 - 0.001);
  EXPECT_NEAR(box.T_world_box.translation.x(), 1.5, 1e-6);
  EXPECT_NEAR(box.T_world_box.translation.z(), 1.5, 1e-6);
}

TEST(SceneFile, PartsAreOneInstance) {
  const StagedScene staged = Parsed(
      "models:\n"
      "  stool:\n"
      "    class: chair\n"
      "    parts:\n"
      "      - {shape: cylinder, radius: 0.2, height: 0.05, material: '#885522', at: [0, 0, 0.4]}\n"
      "      - {repeat: 3, shape: box, size: [0.04, 0.04, 0.4], material: '#885522',\n"
      "         at: [0.15 * cos($i * 120), 0.15 * sin($i * 120), 0]}\n" +
      WithObjects("  - {object: stool, at: [1, 1]}\n"));
  EXPECT_EQ(staged.scene.parts().size(), 4U);
  ASSERT_EQ(staged.scene.instances().size(), 1U);
  EXPECT_NEAR(BoxOf(staged, 0).half_size.z(), 0.225, 1e-6);
}

TEST(SceneFile, FormulasKnowNamesRepetitionsAndWaves) {
  const StagedScene staged = Parsed(
      "numbers: {w: 0.5, h: $w * 2}\n" +
      WithObjects("  - {repeat: 3, shape: box, class: a, size: [$w, (1 + 2) * 0.1, $h], material: "
                  "'#808080', at: [-2 + $i * 2, 4 * sin(30) / -2]}\n"));
  ASSERT_EQ(staged.scene.instances().size(), 3U);
  const OrientedBox& box = BoxOf(staged, 2);
  EXPECT_LT((box.half_size - Eigen::Vector3d(0.25, 0.15, 0.5)).norm(), 1e-6);
  EXPECT_LT((box.T_world_box.translation - Eigen::Vector3d(2, -1, 0.5)).norm(), 1e-6);
}

TEST(SceneFile, ARangeIsDrawnFromTheSeedAndStaysInside) {
  const std::string text = WithObjects(
      "  - {shape: sphere, class: a, radius: [0.1, 0.3], material: '#808080', at: [[1, 2], 0]}\n");
  double smallest = 10;
  double largest = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const double radius = BoxOf(Parsed(text, seed), 0).half_size.x();
    smallest = std::min(smallest, radius);
    largest = std::max(largest, radius);
  }
  EXPECT_GE(smallest, 0.1 - 1e-6);
  EXPECT_LE(largest, 0.3 + 1e-6);
  EXPECT_GT(largest - smallest, 0.12);
}

TEST(SceneFile, ARowFillsFromStartToEnd) {
  const StagedScene staged =
      Parsed(WithObjects("  - {shape: box, name: t, class: a, size: [1, 1, 0.5], material: "
                         "'#808080'}\n"
                         "  - row: [{shape: box, class: b, size: [0.1, 0.2, 0.2], material: "
                         "'#808080'}]\n"
                         "    on: t\n"
                         "    start: -0.2\n"
                         "    end: 0.3\n"
                         "    front: -0.4\n"
                         "    gap: 0.01\n"));
  ASSERT_EQ(staged.scene.instances().size(), 5U);  // 4 * 0.1 + 3 * 0.01 fit into 0.5.
  EXPECT_LT((BoxOf(staged, 1).T_world_box.translation - Eigen::Vector3d(-0.15, -0.3, 0.6)).norm(),
            1e-6);
  EXPECT_NEAR(BoxOf(staged, 4).T_world_box.translation.x(), -0.15 + 3 * 0.11, 1e-6);
}

TEST(SceneFile, OneChangedEntryLeavesTheOthersAsTheyWere) {
  const std::string first = "  - {object: mug, at: [[0, 1], 0]}\n";
  const std::string other = "  - {object: mug, at: [[0, 1], [1, 2]], yaw: [0, 90]}\n";
  const std::string last = "  - {object: mug, at: [[0, 1], 5]}\n";
  const StagedScene a = Parsed(WithObjects(first + first + last));
  const StagedScene b = Parsed(WithObjects(first + other + last));
  EXPECT_EQ(BoxOf(a, 2).T_world_box.translation, BoxOf(b, 2).T_world_box.translation);
}

TEST(SceneFile, SpeedIsTheCamerasSpeed) {
  const StagedScene staged = Parsed(
      "objects: [{object: floor}]\n"
      "camera: {speed: 0.5, sway: 0, sway_angle: 0, waypoints: [{repeat: 36, eye: [2 * cos($i * "
      "10), 2 * sin($i * 10), 1], target: [3 * cos($i * 10), 3 * sin($i * 10), 1]}]}\n");
  EXPECT_NEAR(staged.path.duration(), 2 * std::numbers::pi * 2 / 0.5, 0.3);
  const Eigen::Vector3d step = staged.path.At(1.05).translation - staged.path.At(0.95).translation;
  EXPECT_NEAR(step.norm(), 0.05, 0.001);
}

TEST(SceneFile, IsLoadedFromAPath) {
  const testing::TemporaryFolder folder;
  const auto path = folder.Write("a scene.yaml", WithObjects("  - {object: mug}\n"));
  const StagedScene staged = MakeScene(path.string(), 1);
  EXPECT_EQ(staged.scene.instances()[0].class_name, "cup");
  EXPECT_TRUE(staged.scene.parts()[0].material.texture) << "painted";
}

TEST(SceneFile, TheDocumentationsExampleIsAScene) {
  const std::string page =
      testing::ReadAll(std::filesystem::path(SEMSLAM_SOURCE_DIR) / "docs/scene-files.md");
  const std::string fence = "```yaml\n";
  const std::size_t begin = page.find(fence);
  ASSERT_NE(begin, std::string::npos);
  const std::size_t end = page.find("```", begin + fence.size());
  const StagedScene staged = Parsed(page.substr(begin + fence.size(), end - begin - fence.size()));
  EXPECT_EQ(staged.scene.instances().size(), 5U);
}

TEST(SceneFile, TheDocumentationNamesEveryReadyMadeObject) {
  const std::string page =
      testing::ReadAll(std::filesystem::path(SEMSLAM_SOURCE_DIR) / "docs/scene-files.md");
  const std::string table = page.substr(page.find("## Ready-made objects"));
  for (const CatalogEntry& entry : ObjectCatalog())
    EXPECT_NE(table.find(entry.name), std::string::npos) << entry.name;
}

TEST(SceneFile, AMissingFileIsAnError) {
  EXPECT_EQ(InputErrorOf([] { MakeScene("no/such.yaml", 1); }),
            "scene no/such.yaml: expected a file, found none");
  EXPECT_EQ(InputErrorOf([] { MakeScene("/", 1); }), "scene /: expected a file, found none");
}

// A wrong text and what is said of it.
struct Mistake {
  const char* name;
  std::string text;
  std::string message;  // After "my.yaml:".
};

void PrintTo(const Mistake& mistake, std::ostream* stream) { *stream << mistake.name; }

class SceneFileMistake : public ::testing::TestWithParam<Mistake> {};

TEST_P(SceneFileMistake, IsNamedWithItsLine) {
  EXPECT_EQ(InputErrorOf([] { Parsed(GetParam().text); }), "my.yaml:" + GetParam().message);
}

std::string Item(const std::string& item) { return WithObjects("  - " + item + "\n"); }
std::string WithWaypoints(const std::string& waypoints) {
  return "objects: [{object: mug}]\ncamera: {waypoints: " + waypoints + "}\n";
}

INSTANTIATE_TEST_SUITE_P(
    All,
    SceneFileMistake,
    ::testing::Values(
        Mistake{"Empty", "", "1: expected a scene, found nothing"},
        Mistake{"OnlyComments", "# nothing\n", "1: expected a scene, found nothing"},
        Mistake{"NoMap", "- a\n- b\n", "1: expected a map of keys and values, found a list of 2"},
        Mistake{"NotYaml", "objects: [1, 2\ncamera: }",
                "2: expected YAML, found what is none: end of sequence flow not found"},
        Mistake{"Binary", std::string("\x89PNG\0\0", 6),
                "1: expected YAML text, found a binary file"},
        Mistake{"NoObjects", kCamera, "1: expected a key 'objects', found none"},
        Mistake{"NoCamera", "objects:\n  - {object: mug}\n",
                "1: expected a key 'camera', found none"},
        Mistake{"UnknownTopKey",
                "object:\n  - {object: mug}\n" + WithObjects("  - {object: mug}\n"),
                "2: object: unknown key, did you mean 'objects'?"},
        Mistake{"UnknownKey", Item("{object: mug, yav: 3}"),
                "2: objects[0].yav: unknown key, did you mean 'yaw'?"},
        Mistake{"KeyTwice", Item("{object: mug, yaw: 3, yaw: 4}"),
                "2: objects[0]: key 'yaw' is there twice"},
        Mistake{"WrongType", Item("{object: mug, at: over there}"),
                "2: objects[0].at: expected a list of 2 or 3 numbers, found 'over there'"},
        Mistake{"NotANumber", Item("{object: mug, at: [1, x]}"),
                "2: objects[0].at[1]: expected a number, found 'x'"},
        Mistake{"NaN", Item("{object: mug, yaw: nan}"),
                "2: objects[0].yaw: expected a number in [-720, 720], found nan"},
        Mistake{"DividedByZero", Item("{object: mug, yaw: 1 / 0}"),
                "2: objects[0].yaw: expected a number in [-720, 720], found inf"},
        Mistake{"RangeUpsideDown", Item("{object: mug, yaw: [5, 1]}"),
                "2: objects[0].yaw: expected a range [low, high], found [5, 1]"},
        Mistake{"MissingKey", Item("{shape: box, class: a, material: '#808080'}"),
                "2: objects[0]: expected a key 'size', found none"},
        Mistake{"NoClass", Item("{shape: sphere, radius: 1, material: '#808080'}"),
                "2: objects[0]: expected a key 'class', found none"},
        Mistake{"NothingToMake", Item("{at: [0, 0]}"),
                "2: objects[0]: expected one of object, shape, parts, group, scatter, row, found "
                "none"},
        Mistake{"ImpossibleSize",
                Item("{shape: sphere, class: a, radius: -1, material: '#808080'}"),
                "2: objects[0].radius: expected a number in [0.0002, 100], found -1"},
        Mistake{"RoundingTooLarge",
                Item("{shape: box, class: a, size: [1, 1, 0.1], round: 0.06, material: '#808080'}"),
                "2: objects[0].round: expected a number in [1e-05, 0.05], found 0.06"},
        Mistake{"SizeForNone", Item("{object: mug, size: 3}"),
                "2: objects[0].size: expected none, as a mug has always the same size"},
        Mistake{"UnknownObject", Item("{object: keybord}"),
                "2: objects[0].object: unknown object 'keybord', did you mean 'keyboard'?"},
        Mistake{"UnknownMaterial", Item("{object: wall, size: [3, 2], material: marble}"),
                "2: objects[0].material: expected a material's name, found 'marble'"},
        Mistake{"BadColor", Item("{object: wall, size: [3, 2], material: '#12345'}"),
                "2: objects[0].material: expected a colour '#rrggbb', found '#12345'"},
        Mistake{"UnknownNumber", Item("{object: mug, yaw: $angle}"),
                "2: objects[0].yaw: expected the name of a number, found '$angle'"},
        Mistake{"NameTwice",
                WithObjects("  - {object: mug, name: m}\n  - {object: mug, name: m}\n"),
                "3: objects[1].name: expected a new name, found 'm' again"},
        Mistake{"OnNothing",
                WithObjects("  - {object: desk, name: desk}\n  - {object: mug, on: "
                            "dask}\n"),
                "3: objects[1].on: expected the name of an object above ('desk'?), found 'dask'"},
        Mistake{"NoSuchPlace",
                WithObjects("  - {object: desk, name: d}\n  - {object: mug, on: "
                            "d/7}\n"),
                "3: objects[1].on: expected a place of 'd', from /1 to /1, found 'd/7'"},
        Mistake{"ModelWithOldName",
                "models:\n  mug: {class: cup, parts: []}\n" + WithObjects("  - {object: mug}\n"),
                "2: models.mug: expected a new name, found that of a ready-made object"},
        Mistake{"ChooseFromNone", Item("{object: {choose: []}}"),
                "2: objects[0].object.choose: expected a list to choose from, found a list of 0"},
        Mistake{"TooMany", Item("{repeat: 1000000, object: mug}"),
                "2: objects[0].repeat: expected a number in [0, 500], found 1e+06"},
        Mistake{"OneWaypoint", WithWaypoints("[{eye: [0, 0, 1], target: [1, 0, 1]}]"),
                "2: camera.waypoints: expected at least 2 waypoints, found 1"},
        Mistake{"LooksStraightDown",
                WithWaypoints("[{eye: [0, 0, 1], target: [0, 0, 0]}, {eye: [0, 0, 1], target: [1, "
                              "0, 0]}]"),
                "2: camera.waypoints[0]: expected a target aside of the eye, found one straight "
                "above, below or at it"},
        Mistake{"TurnsOverTheVertical",
                WithWaypoints("[{eye: [0, 0, 1], target: [1, 0, 1]}, {eye: [0, 0, 1], target: [-1, "
                              "0, 1]}]"),
                "2: camera.waypoints: expected views that turn little from waypoint to waypoint, "
                "found a turn over the vertical after waypoint 0"},
        Mistake{"TooManyLamps", "lamps: [1, 2, 3, 4]\n" + WithObjects("  - {object: mug}\n"),
                "1: lamps: expected a list of at most 3 lamps, found a list of 4"}),
    [](const ::testing::TestParamInfo<Mistake>& test) { return test.param.name; });

TEST(SceneFile, ADeepNestIsAnErrorAndNoCrash) {
  const std::string deep = "objects: " + std::string(5000, '[') + std::string(5000, ']') + '\n';
  EXPECT_FALSE(InputErrorOf([&] { Parsed(deep); }).empty());
}

TEST(SceneFile, AliasesThatMultiplyAreAnErrorAndNoCrash) {
  std::string bomb = "about: &a0 [x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    bomb += "k" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + before;
    for (int k = 0; k < 8; ++k) bomb += ", " + before;
    bomb += "]\n";
  }
  EXPECT_NE(InputErrorOf([&] { Parsed(bomb); }).find("expected at most 50000 values"),
            std::string::npos);
}

TEST(SceneFile, AMapOfManyThousandKeysIsAnErrorAndSoon) {
  std::string text;
  for (int i = 0; i < 45000; ++i) text += 'k' + std::to_string(i) + ": v\n";
  EXPECT_EQ(InputErrorOf([&] { Parsed(text); }),
            "my.yaml:2001: expected at most 2000 keys, found more");
}

TEST(SceneFile, AnAliasOfItselfIsAnErrorAndNoCrash) {
  EXPECT_FALSE(InputErrorOf([] { Parsed("objects: &a [*a, *a]\n"); }).empty());
}

TEST(SceneFile, EndlessRepetitionOfNothingIsAnError) {
  std::string text = "objects:\n  - ";
  for (int i = 0; i < 8; ++i) text += "{repeat: 500, group: [";
  text += "{repeat: 0, object: mug}";
  for (int i = 0; i < 8; ++i) text += "]}";
  text += '\n';
  EXPECT_NE(InputErrorOf([&] { Parsed(text + kCamera); }).find("steps in all"), std::string::npos);
}

}  // namespace
}  // namespace semslam

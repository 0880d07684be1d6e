// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/objects_io.h"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/files.h"

namespace semslam {
namespace {

using testing::ReadAll;
using testing::TemporaryFolder;

const std::vector<ClassRecord> kClasses = {{1, "cup", {255, 0, 10}}, {7, "keyboard", {1, 2, 3}}};

nlohmann::json WriteAndParse(const std::vector<ClassRecord>& classes,
                             const std::vector<ObjectRecord>& objects) {
  const TemporaryFolder folder;
  WriteObjects(folder.path() / "objects.json", classes, objects);
  return nlohmann::json::parse(ReadAll(folder.path() / "objects.json"));
}

TEST(ObjectsIo, WritesAllThatIsKnownOfAnObject) {
  ObjectRecord object;
  object.id = 3;
  object.label = 7;
  object.confidence = 0.75;
  object.entropy = 0.25;
  object.num_views = 12;
  object.num_points = 3456;
  object.centroid = {1, 2, 3};
  object.box = {{Eigen::Quaterniond(-0.5, 0.5, -0.5, 0.5), {4, 5, 6}}, {0.1, 0.2, 0.3}};
  const nlohmann::json json = WriteAndParse(kClasses, {object});

  ASSERT_EQ(json["objects"].size(), 1u);
  const nlohmann::json& written = json["objects"][0];
  EXPECT_EQ(written["id"], 3);
  EXPECT_EQ(written["label"], 7);
  EXPECT_EQ(written["class"], "keyboard");
  EXPECT_EQ(written["confidence"], 0.75);
  EXPECT_EQ(written["entropy"], 0.25);
  EXPECT_EQ(written["num_views"], 12);
  EXPECT_EQ(written["num_points"], 3456);
  EXPECT_EQ(written["centroid"], nlohmann::json({1.0, 2.0, 3.0}));
  EXPECT_EQ(written["box"]["center"], nlohmann::json({4.0, 5.0, 6.0}));
  EXPECT_EQ(written["box"]["size"], nlohmann::json({0.2, 0.4, 0.6}));
  EXPECT_EQ(written["box"]["rotation_xyzw"], nlohmann::json({-0.5, 0.5, -0.5, 0.5}));
}

TEST(ObjectsIo, WritesTheClassTableUnitsAndFrame) {
  const nlohmann::json json = WriteAndParse(kClasses, {});
  ASSERT_EQ(json["classes"].size(), 2u);
  EXPECT_EQ(json["classes"][0]["label"], 1);
  EXPECT_EQ(json["classes"][0]["name"], "cup");
  EXPECT_EQ(json["classes"][0]["color_rgb"], nlohmann::json({255, 0, 10}));
  EXPECT_EQ(json["units"]["length"], "metre");
  EXPECT_TRUE(json["frame"].is_string());
  EXPECT_TRUE(json["objects"].is_array());
}

TEST(ObjectsIo, WritesClassNamesThatAreNoUtf8) {
  EXPECT_EQ(WriteAndParse({{1, "caf\xe9", {}}}, {})["classes"][0]["name"], "caf\xef\xbf\xbd");
}

}  // namespace
}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semslam/io/objects_io.h"

#include "support/files.h"

namespace semslam {
namespace {

using ::testing::HasSubstr;
using testing::InputErrorOf;
using testing::ReadAll;
using testing::TemporaryFolder;

const std::vector<ClassRecord> kClasses = {{1, "cup", {255, 0, 10}}, {7, "keyboard", {1, 2, 3}}};

ObjectRecord SomeObject() {
  ObjectRecord object;
  object.id = 3;
  object.label = 7;
  object.confidence = 0.75;
  object.entropy = 0.25;
  object.num_views = 12;
  object.num_points = 3456;
  object.centroid = {1, 2, 3};
  object.box = {{Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {4, 5, 6}}, {0.1, 0.2, 0.3}};
  object.supporting_segment = 11;
  object.supporting_object = 2;
  return object;
}

TEST(ObjectsReader, ReadsWhatWasWritten) {
  const TemporaryFolder folder;
  const ObjectRecord expected = SomeObject();
  WriteObjects(folder.path() / "objects.json", kClasses, {expected});
  const ObjectsFile file = ReadObjects(folder.path() / "objects.json");
  ASSERT_EQ(file.classes.size(), 2U);
  EXPECT_EQ(file.classes[1].label, 7U);
  EXPECT_EQ(file.classes[1].name, "keyboard");
  EXPECT_EQ(file.classes[0].color, (Rgb{255, 0, 10}));
  ASSERT_EQ(file.objects.size(), 1U);
  const ObjectRecord& object = file.objects[0];
  EXPECT_EQ(object.id, expected.id);
  EXPECT_EQ(object.label, expected.label);
  EXPECT_EQ(object.confidence, expected.confidence);
  EXPECT_EQ(object.entropy, expected.entropy);
  EXPECT_EQ(object.num_views, expected.num_views);
  EXPECT_EQ(object.num_points, expected.num_points);
  EXPECT_EQ(object.centroid, expected.centroid);
  EXPECT_LT(RotationAngle(object.box.T_world_box, expected.box.T_world_box), 1e-9);
  EXPECT_EQ(object.box.T_world_box.translation, expected.box.T_world_box.translation);
  EXPECT_LT((object.box.half_size - expected.box.half_size).norm(), 1e-12);
  EXPECT_EQ(object.supporting_segment, expected.supporting_segment);
  EXPECT_EQ(object.supporting_object, expected.supporting_object);
}

TEST(ObjectsReader, NamesTheFieldThatIsWrong) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "objects.json";
  WriteObjects(path, kClasses, {SomeObject()});
  const std::string good = ReadAll(path);
  const auto error_with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    folder.Write("objects.json", text);
    return InputErrorOf([&] { ReadObjects(path); });
  };
  EXPECT_THAT(error_with("{", "["), HasSubstr("objects.json: expected JSON, found an error at"));
  EXPECT_THAT(error_with("semslam objects 3", "objects 1"), HasSubstr("format: expected semslam"));
  EXPECT_THAT(error_with("\"classes\"", "\"klasses\""), HasSubstr("classes: missing"));
  EXPECT_THAT(error_with("\"label\": 7", "\"label\": 1"), HasSubstr("classes[1].label: expected"));
  EXPECT_THAT(error_with("255", "256"), HasSubstr("classes[0].color_rgb: expected values"));
  EXPECT_THAT(error_with("0.75", "\"high\""),
              HasSubstr("objects[0].confidence: expected a number"));
  EXPECT_THAT(error_with("3456", "-1"), HasSubstr("objects[0].num_points: expected a whole"));
  EXPECT_THAT(error_with("\"label\": 7,\n      \"class\"", "\"label\": 8,\n      \"class\""),
              HasSubstr("objects[0].label: expected a label of the class table, found \"8\""));
}

TEST(ObjectsReader, SaysThatThereIsNoFile) {
  EXPECT_THAT(InputErrorOf([] { ReadObjects("/nowhere/objects.json"); }),
              HasSubstr("/nowhere/objects.json: cannot read"));
}

}  // namespace
}  // namespace semslam

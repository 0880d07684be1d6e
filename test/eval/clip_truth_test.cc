// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/eval/clip_truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semslam/io/cloud_io.h"

#include "eval/small_scene.h"
#include "support/files.h"

namespace semslam {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::InputErrorOf;
using testing::SceneBuilder;
using testing::SmallDesk;
using testing::TemporaryFolder;

constexpr std::uint32_t kDesk = 1;
constexpr std::uint32_t kPaper = 7;

constexpr std::string_view kOneInstance =
    R"({"instances": [{"id": 1, "class": "cup", "center": [0, 0, 0],
        "orientation": [0, 0, 0, 1], "size": [0.1, 0.1, 0.1]}]})";

TEST(ClipTruth, ASheetIsOneRegionWithWhatItLiesOn) {
  const auto region = RegionOfInstance(SmallDesk());
  EXPECT_EQ(region.at(kPaper), kDesk);
  for (std::uint32_t id = 1; id < kPaper; ++id) EXPECT_EQ(region.at(id), id);
}

TEST(ClipTruth, AThinWallIsNoSheetOnTheFloorItStandsOn) {
  SceneBuilder scene;
  scene.AddBox("floor", {0, 0, 0}, {1, 1, 0});
  scene.AddBox("box", {0, 0, 0.2}, {0.3, 0.3, 0.4});
  scene.AddBox("page", {0.3, 0.3, 0.02}, {0.1, 0.1, 0});
  const auto region = RegionOfInstance(scene.truth());
  EXPECT_EQ(region.at(2), 2U);
  EXPECT_EQ(region.at(3), 3U);  // 2 cm above the floor.
}

TEST(ClipTruth, PagesOnAPosterOnAWallAreOneRegion) {
  SceneBuilder scene;
  scene.AddBox("page", {0.1, 0, 0.004}, {0.05, 0.05, 0});
  scene.AddBox("poster", {0, 0, 0.002}, {0.3, 0.2, 0});
  scene.AddBox("wall", {0, 0, 0}, {1, 1, 0});
  const auto region = RegionOfInstance(scene.truth());
  EXPECT_EQ(region.at(2), 1U);
  EXPECT_EQ(region.at(3), 1U);
}

TEST(ClipTruth, TheSeenPartIsTheBoxOfItsSamples) {
  ClipTruth truth = SmallDesk();
  const InstanceRecord& cup = truth.instances[2];
  // Only the front face, y = -4 cm, and of it the lower half.
  ClipTruth seen = truth;
  seen.positions.clear();
  seen.instance_of_sample.clear();
  for (std::size_t i = 0; i < truth.positions.size(); ++i) {
    const Eigen::Vector3f& p = truth.positions[i];
    if (truth.instance_of_sample[i] != cup.id || truth.normals[i].y() > -0.5F) continue;
    if (p.z() > 0.05F) continue;
    seen.positions.push_back(p);
    seen.instance_of_sample.push_back(cup.id);
  }
  const SeenPart part = FindSeenPart(seen, cup);
  EXPECT_EQ(part.num_samples, 16U * 10U);
  EXPECT_LT((part.centroid - Eigen::Vector3d(-0.4, 0.06, 0.025)).norm(), 1e-6);
  EXPECT_LT((part.box.half_size - Eigen::Vector3d(0.0375, 0, 0.0225)).norm(), 1e-6);
  EXPECT_LT((part.box.T_world_box.translation - part.centroid).norm(), 1e-6);
  EXPECT_NEAR(part.seen_share, 0.5, 1e-9);
  EXPECT_NEAR(FindSeenPart(truth, cup).seen_share, 1.0, 1e-9);
}

TEST(ClipTruth, WhatWasNotSeenHasNoSamples) {
  const ClipTruth truth = SmallDesk();
  EXPECT_EQ(FindSeenPart(truth, {.id = 99, .class_name = "cup", .box = {}}).num_samples, 0U);
}

class ClipFolder {
 public:
  ClipFolder() {
    folder_.Write("groundtruth.txt", "1 0 0 0 0 0 0 1\n");
    folder_.Write("instances.json", kOneInstance);
    WriteSurface(1);
  }
  void WriteSurface(std::uint32_t label) {
    const std::vector<Eigen::Vector3f> points(3, Eigen::Vector3f::UnitZ());
    const std::vector<std::uint32_t> labels(3, label);
    WritePcd(folder_.path() / "surface.pcd",
             {.positions = points, .normals = points, .labels = labels});
  }
  const TemporaryFolder& folder() const { return folder_; }
  std::string Error() const {
    return InputErrorOf([&] { ReadClipTruth(folder_.path()); });
  }

 private:
  TemporaryFolder folder_;
};

TEST(ReadClipTruth, ReadsWhatIsThere) {
  const ClipFolder clip;
  const ClipTruth truth = ReadClipTruth(clip.folder().path());
  EXPECT_EQ(truth.trajectory.size(), 1U);
  ASSERT_EQ(truth.instances.size(), 1U);
  EXPECT_EQ(truth.instances[0].class_name, "cup");
  EXPECT_NEAR(truth.instances[0].box.half_size.x(), 0.05, 1e-12);
  EXPECT_EQ(truth.instance_of_sample, (std::vector<std::uint32_t>{1, 1, 1}));
}

TEST(ReadClipTruth, NamesTheFileThatIsMissing) {
  for (const char* name : {"groundtruth.txt", "instances.json", "surface.pcd"}) {
    const ClipFolder clip;
    std::filesystem::remove(clip.folder().path() / name);
    EXPECT_THAT(clip.Error(), AllOf(HasSubstr(name), HasSubstr("cannot read")));
  }
}

TEST(ReadClipTruth, NamesTheFieldThatIsWrong) {
  const auto with = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const std::string good(kOneInstance);
  for (const auto& [text, words] : std::vector<std::pair<std::string, std::string>>{
           {good.substr(0, 50), "instances.json: expected JSON"},
           {"[]", "instances.json: expected an object"},
           {"{}", "instances.json: instances: missing"},
           {with(good, "\"id\": 1", "\"id\": 0"), "instances[0].id: expected an id above 0"},
           {with(good, "\"id\": 1", "\"id\": -1"), "instances[0].id: expected a whole number"},
           {with(good, "\"cup\"", "7"), "instances[0].class: expected a text"},
           {with(good, "0, 0, 0, 1", "0, 0, 0, 2"), "instances[0].orientation: expected a quat"},
           {with(good, "[0, 0, 0]", "[0, 0]"), "instances[0].center: expected 3 numbers"},
           {with(good, "0.1, 0.1, 0.1", "0.1, -1, 0.1"), "instances[0].size: expected sizes"}}) {
    const ClipFolder clip;
    clip.folder().Write("instances.json", text);
    EXPECT_THAT(clip.Error(), HasSubstr(words));
  }
}

TEST(ReadClipTruth, SaysThatTheSurfaceDoesNotFit) {
  ClipFolder clip;
  clip.WriteSurface(2);
  EXPECT_THAT(clip.Error(), AllOf(HasSubstr("surface.pcd"), HasSubstr("found 2")));
  WritePcd(clip.folder().path() / "surface.pcd", {});
  EXPECT_THAT(clip.Error(), AllOf(HasSubstr("surface.pcd"), HasSubstr("found none")));
  const std::vector<Eigen::Vector3f> points(3, Eigen::Vector3f::UnitZ());
  WritePcd(clip.folder().path() / "surface.pcd", {.positions = points});
  EXPECT_THAT(clip.Error(), AllOf(HasSubstr("surface.pcd"), HasSubstr("normal_x")));
}

}  // namespace
}  // namespace semslam

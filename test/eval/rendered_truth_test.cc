// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
// A clip and a result as files: written by the renderer, and made from its truth.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semslam/eval/map_evaluation.h"
#include "semslam/io/cloud_io.h"
#include "semslam/render/clip_writer.h"

#include "eval/small_scene.h"
#include "support/files.h"

namespace semslam {
namespace {

using ::testing::AllOf;
using testing::ExpectPerfect;
using ::testing::HasSubstr;
using testing::InputErrorOf;
using testing::PerfectResult;
using testing::TemporaryFolder;

RenderedClip SmallClip() {
  RenderedClip::Options options;
  options.num_frames = 8;
  options.fps = 2;
  options.camera = {.width = 160, .height = 120, .fx = 130, .fy = 130, .cx = 79.5, .cy = 59.5};
  options.MakeClean();
  return RenderedClip(options);
}

void WriteResult(const MapResult& result, const std::filesystem::path& folder) {
  WriteTrajectory(folder / "CameraTrajectory.txt", result.trajectory);
  WritePcd(folder / "segmentation.pcd", {.positions = result.positions, .labels = result.segments});
  WritePcd(folder / "semantic_map.pcd", {.positions = result.positions, .labels = result.labels});
  WriteObjects(folder / "objects.json", result.classes, result.objects);
}

class RenderedTruth : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    clip_folder_ = std::make_unique<TemporaryFolder>();
    WriteClip(SmallClip(), clip_folder_->path(), {});
  }
  static void TearDownTestSuite() { clip_folder_.reset(); }

  void SetUp() override { WriteResult(PerfectResult(truth_), folder_.path()); }

  std::string Error() const {
    return InputErrorOf([&] { ReadMapResult(folder_.path()); });
  }

  static inline std::unique_ptr<TemporaryFolder> clip_folder_;
  const ClipTruth truth_ = ReadClipTruth(clip_folder_->path());
  TemporaryFolder folder_;
};

TEST_F(RenderedTruth, ScoresOneEverywhere) {
  const MapEvaluation evaluation = EvaluateMap(truth_, ReadMapResult(folder_.path()));
  EXPECT_EQ(evaluation.classes.size(), 5U);
  EXPECT_GE(evaluation.objects[0].num_true, 5U);
  EXPECT_GT(evaluation.surface.instance_of_point.size(), 5000U);
  ExpectPerfect(evaluation);
}

TEST_F(RenderedTruth, PostersAreOneRegionWithTheWallAndPagesWithTheDesk) {
  const auto region = RegionOfInstance(truth_);
  std::map<std::string, std::set<std::uint32_t>> regions_of_class;
  for (const InstanceRecord& instance : truth_.instances) {
    if (FindSeenPart(truth_, instance).num_samples < 20) continue;
    regions_of_class[instance.class_name].insert(region.at(instance.id));
  }
  EXPECT_EQ(regions_of_class["poster"].size(), 1U);
  EXPECT_EQ(regions_of_class["poster"], regions_of_class["wall"]);
  EXPECT_EQ(regions_of_class["paper"], regions_of_class["desk"]);
  EXPECT_EQ(regions_of_class["cup"].size(), 2U);
}

TEST_F(RenderedTruth, AResultWithAFileMissingIsRefused) {
  for (const char* name :
       {"CameraTrajectory.txt", "segmentation.pcd", "semantic_map.pcd", "objects.json"}) {
    SetUp();
    std::filesystem::remove(folder_.path() / name);
    EXPECT_THAT(Error(), AllOf(HasSubstr(name), HasSubstr("cannot read")));
  }
}

TEST_F(RenderedTruth, CloudsOfDifferentPointsAreRefused) {
  std::vector<Eigen::Vector3f> points = truth_.positions;
  std::vector<std::uint32_t> labels(points.size(), 0);
  points[7].x() += 0.001F;
  WritePcd(folder_.path() / "semantic_map.pcd", {.positions = points, .labels = labels});
  EXPECT_THAT(Error(),
              AllOf(HasSubstr("semantic_map.pcd"), HasSubstr("points of segmentation.pcd")));
}

TEST_F(RenderedTruth, LabelsThatTheClassTableDoesNotHaveAreRefused) {
  const std::vector<std::uint32_t> labels(truth_.positions.size(), 77);
  WritePcd(folder_.path() / "semantic_map.pcd", {.positions = truth_.positions, .labels = labels});
  EXPECT_THAT(Error(), AllOf(HasSubstr("semantic_map.pcd"), HasSubstr("77")));
}

TEST_F(RenderedTruth, ACloudWithoutLabelsIsRefused) {
  WritePcd(folder_.path() / "segmentation.pcd", {.positions = truth_.positions});
  EXPECT_THAT(Error(), AllOf(HasSubstr("segmentation.pcd"), HasSubstr("label")));
}

}  // namespace
}  // namespace semslam

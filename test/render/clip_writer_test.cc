// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/clip_writer.h"

#include <filesystem>
#include <sstream>
#include <stdexcept>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "semslam/config/settings.h"
#include "semslam/io/trajectory_io.h"
#include "semslam/io/tum_dataset.h"

#include "support/desk_clip.h"
#include "support/files.h"
#include "support/matchers.h"

namespace semslam {
namespace {

using testing::InputErrorOf;
using testing::ReadAll;
using testing::Rigid3Near;
using testing::SmallDeskClipOptions;
using testing::TemporaryFolder;

// A desk of two frames, written into a folder.
struct WrittenClip {
  WrittenClip() { WriteClip(clip, folder.path(), {}); }

  TemporaryFolder folder;
  RenderedClip clip = RenderedClip(SmallDeskClipOptions(2));
};

// Written once for all that only read it.
class ClipWriterTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { written_ = new WrittenClip; }
  static void TearDownTestSuite() {
    delete written_;
    written_ = nullptr;
  }

  static const RenderedClip& clip() { return written_->clip; }
  static const std::filesystem::path& folder() { return written_->folder.path(); }

 private:
  static inline const WrittenClip* written_ = nullptr;
};

TEST_F(ClipWriterTest, TheFolderReadsBackAsTheClip) {
  TumDataset dataset(folder(), folder() / "associations.txt",
                     {.width = clip().camera().width(), .height = clip().camera().height()});
  for (std::size_t i = 0; i < 2; ++i) {
    const std::optional<RgbdImage> read = dataset.Next();
    ASSERT_TRUE(read);
    const RgbdImage expected = clip().Image(i);
    EXPECT_EQ(read->time, expected.time);
    EXPECT_EQ(cv::norm(read->color, expected.color, cv::NORM_INF), 0);
    EXPECT_LT(cv::norm(read->depth, expected.depth, cv::NORM_INF), 1e-6);
  }
}

TEST_F(ClipWriterTest, GroundTruthIsTheCamerasPath) {
  const Trajectory truth = ReadTrajectory(folder() / "groundtruth.txt");
  ASSERT_EQ(truth.size(), 2U);
  EXPECT_EQ(truth[1].time, clip().Time(1));
  EXPECT_THAT(truth[1].T_world_camera, Rigid3Near(clip().T_world_camera(1), 1e-8, 1e-8));
}

TEST_F(ClipWriterTest, SettingsAreOfTheClipsCamera) {
  const Settings settings = LoadSettings(folder() / "settings.yaml");
  EXPECT_DOUBLE_EQ(settings.camera.fx, clip().camera().fx());
  EXPECT_DOUBLE_EQ(settings.camera.k3, clip().camera().parameters().k3);
  EXPECT_DOUBLE_EQ(settings.depth_factor, 5000);
}

TEST_F(ClipWriterTest, LabelsNameInstancesOfTheList) {
  const cv::Mat labels = cv::imread(
      (folder() / "labels" / (FormatTime(clip().Time(0)) + ".png")).string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(labels.type(), CV_16UC1);
  EXPECT_EQ(cv::norm(labels, clip().Frame(0).ideal.labels, cv::NORM_INF), 0);
  const auto json = nlohmann::json::parse(ReadAll(folder() / "instances.json"));
  ASSERT_EQ(json["instances"].size(), clip().instances().size());
  EXPECT_EQ(json["instances"][4]["id"], 5);
  EXPECT_EQ(json["instances"][4]["class"], clip().instances()[4].class_name);
}

TEST_F(ClipWriterTest, DetectionsNameClassesOfTheirList) {
  std::istringstream names(ReadAll(folder() / "detections" / "classes.names"));
  std::string name;
  int num_names = 0;
  while (std::getline(names, name)) ++num_names;
  EXPECT_EQ(num_names, 5);
  std::istringstream lines(
      ReadAll(folder() / "detections" / (FormatTime(clip().Time(0)) + ".txt")));
  int index = 0;
  double cx = 0;
  double cy = 0;
  double width = 0;
  double height = 0;
  double score = 0;
  int num_lines = 0;
  while (lines >> index >> cx >> cy >> width >> height >> score) {
    EXPECT_LT(index, num_names);
    EXPECT_GE(cx - width / 2, -1e-6);
    EXPECT_LE(cy + height / 2, 1 + 1e-6);
    EXPECT_GT(score, 0.5);
    EXPECT_LT(score, 1.0);
    ++num_lines;
  }
  EXPECT_TRUE(lines.eof());
  EXPECT_GE(num_lines, 3);
}

TEST(ClipWriter, AnEarlierClipIsReplaced) {
  const WrittenClip written;
  const RenderedClip shorter(SmallDeskClipOptions(1));
  WriteClip(shorter, written.folder.path(), {});
  EXPECT_EQ(ReadTrajectory(written.folder.path() / "groundtruth.txt").size(), 1U);
  EXPECT_FALSE(exists(written.folder.path() / "rgb" / (FormatTime(written.clip.Time(1)) + ".png")));
}

TEST(ClipWriter, AnInterruptedClipHasNoLists) {
  const WrittenClip written;
  const auto interrupt = [](std::size_t) { throw std::runtime_error("enough"); };
  const RenderedClip clip(SmallDeskClipOptions(1));
  EXPECT_THROW(WriteClip(clip, written.folder.path(), {}, interrupt), std::runtime_error);
  for (const char* name : {"rgb.txt", "depth.txt", "associations.txt", "groundtruth.txt"})
    EXPECT_FALSE(exists(written.folder.path() / name)) << name;
}

TEST(ClipWriter, AFolderWithOtherFilesIsRefusedAndLeftAlone) {
  const TemporaryFolder folder;
  const auto file = folder.Write("rgb.txt", "somebody's recording");
  const RenderedClip clip(SmallDeskClipOptions(1));
  EXPECT_NE(InputErrorOf([&] { WriteClip(clip, folder.path(), {}); }).find("other files"),
            std::string::npos);
  EXPECT_EQ(ReadAll(file), "somebody's recording");
}

TEST(ClipWriter, AFolderThatCannotBeMadeIsAnError) {
  const TemporaryFolder folder;
  const RenderedClip clip(SmallDeskClipOptions(1));
  const auto file = folder.Write("taken", "");
  EXPECT_NE(InputErrorOf([&] { WriteClip(clip, file / "clip", {}); }).find("taken"),
            std::string::npos);
}

TEST(DetectFromLabels, WithoutFaultsGivesTheBoxesOfVisiblePixels) {
  cv::Mat labels(100, 200, CV_16UC1, cv::Scalar(1));
  labels(cv::Rect(20, 30, 40, 25)).setTo(2);
  labels(cv::Rect(100, 10, 3, 3)).setTo(3);  // Too small.
  const std::vector<Instance> instances = {{1, "desk", {}}, {2, "cup", {}}, {3, "mouse", {}}};
  DetectionOptions options;
  options.miss_rate = 0;
  options.box_jitter = 0;
  const std::vector<TrueDetection> found = DetectFromLabels(labels, instances, 1, 0, options);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(options.class_names[found[0].class_index], "cup");
  EXPECT_EQ(found[0].box, cv::Rect2d(20, 30, 40, 25));
}

TEST(DetectFromLabels, MissesAsOftenAsSaid) {
  cv::Mat labels(50, 50, CV_16UC1, cv::Scalar(1));
  const std::vector<Instance> instances = {{1, "cup", {}}};
  DetectionOptions options;
  options.miss_rate = 0.25;
  int num_found = 0;
  for (std::uint64_t frame = 0; frame < 2000; ++frame) {
    num_found += static_cast<int>(DetectFromLabels(labels, instances, 1, frame, options).size());
  }
  EXPECT_NEAR(num_found, 1500, 80);  // Four standard deviations.
}

}  // namespace
}  // namespace semslam

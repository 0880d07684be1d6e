// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/detection_recorder.h"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "semslam/semantics/recorded_detector.h"

#include "support/files.h"

namespace semslam {
namespace {

using testing::InputErrorOf;
using testing::TemporaryFolder;

constexpr TimeNs kTime = 1'305'031'102'175'304'000;

class FixedDetector : public Detector {
 public:
  explicit FixedDetector(std::vector<Detection> detections) : detections_(std::move(detections)) {}
  std::vector<Detection> Detect(const RgbdImage&) override { return detections_; }
  const ClassTable& classes() const override { return classes_; }

 private:
  std::vector<Detection> detections_;
  ClassTable classes_ = ClassTable({"cup", "tvmonitor"});
};

RgbdImage BlackImage() {
  return {kTime, cv::Mat(120, 160, CV_8UC3, cv::Scalar::all(0)), cv::Mat(120, 160, CV_32FC1)};
}

std::unique_ptr<Detector> TwoThings() {
  return std::make_unique<FixedDetector>(std::vector<Detection>{
      {0, 0.75F, {10, 20, 50, 60}, {0.75F, 0}}, {1, 0.5F, {70.5F, 30, 160, 120}, {0, 0.5F}}});
}

TEST(DetectionRecorder, WhatItWritesReadsBackAsWhatWasDetected) {
  const TemporaryFolder folder;
  DetectionRecorder recorder(TwoThings(), folder.path() / "new" / "detections");
  const std::vector<Detection> detected = recorder.Detect(BlackImage());

  const auto written = folder.path() / "new" / "detections";
  RecordedDetector reader({.folder = written}, ClassTable::FromFile(written / "classes.names"));
  EXPECT_EQ(reader.classes().name(1), "tvmonitor");
  const std::vector<Detection> read = reader.Detect(BlackImage());
  ASSERT_EQ(read.size(), detected.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(read[i].class_id, detected[i].class_id);
    EXPECT_NEAR(read[i].score, detected[i].score, 1e-4);
    EXPECT_GT(IntersectionOverUnion(read[i].box, detected[i].box), 0.999F);
  }
}

TEST(DetectionRecorder, ThePictureHasTheBoxesInTheirClassesColours) {
  const TemporaryFolder folder;
  DetectionRecorder recorder(TwoThings(), folder.path());
  recorder.Detect(BlackImage());
  const cv::Mat picture = cv::imread((folder.path() / (FormatTime(kTime) + ".jpg")).string());
  ASSERT_EQ(picture.size(), cv::Size(160, 120));
  const Rgb color = recorder.classes().color(0);
  const cv::Vec3b edge = picture.at<cv::Vec3b>(45, 10);
  EXPECT_LT(cv::norm(cv::Vec3d(edge) - cv::Vec3d(color.b, color.g, color.r)), 60);
  EXPECT_LT(cv::norm(cv::Vec3d(picture.at<cv::Vec3b>(45, 30))), 30);  // Inside the box.
}

TEST(DetectionRecorder, AnEarlierRecordingGoesAndOtherFilesStay) {
  const TemporaryFolder folder;
  const auto old = folder.Write("12.500000.txt", "0 0.5 0.5 0.1 0.1\n");
  const auto notes = folder.Write("notes.txt", "mine");
  DetectionRecorder recorder(TwoThings(), folder.path());
  EXPECT_FALSE(exists(old));
  EXPECT_TRUE(exists(notes));
}

TEST(DetectionRecorder, AFolderThatCannotBeMadeIsAnError) {
  const TemporaryFolder folder;
  const auto file = folder.Write("taken", "");
  EXPECT_NE(InputErrorOf([&] { DetectionRecorder(TwoThings(), file / "here"); }).find("taken"),
            std::string::npos);
}

}  // namespace
}  // namespace semslam

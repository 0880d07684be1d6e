// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "semslam/base/error.h"
#include "semslam/semantics/network_detector.h"

#include "semantics/onnx_input.h"
#include "support/files.h"

namespace semslam {
namespace {

using ::testing::ElementsAre;
using ::testing::FloatEq;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

NetworkOptions OptionsOf(const std::string& name) {
  NetworkOptions options;
  options.config =
      std::filesystem::path(SEMSLAM_SOURCE_DIR) / "test" / "semantics" / "onnx" / (name + ".onnx");
  return options;
}

// make_networks.py says what these two networks always see; both say the same.
class OnnxDetectorTest : public ::testing::TestWithParam<std::string> {};

TEST_P(OnnxDetectorTest, GivesBoxesOfTheImageAndScores) {
  const auto detector =
      std::make_unique<NetworkDetector>(OptionsOf(GetParam()), ClassTable({"a", "b"}));
  // Twice the input's size, without its borders above and below, of 8 pixels there.
  const RgbdImage image{0, cv::Mat(96, 128, CV_8UC3, cv::Scalar(1, 2, 3)), {}};
  const std::vector<Detection> found = detector->Detect(image);
  ASSERT_EQ(found.size(), 2U) << "one overlaps a better one, one has a low score";
  EXPECT_EQ(found[0].class_id, 1);
  EXPECT_THAT(found[0].class_scores, ElementsAre(FloatEq(0.2F), FloatEq(0.8F)));
  EXPECT_FLOAT_EQ(found[0].box.min_x, 2 * (32 - 10));
  EXPECT_FLOAT_EQ(found[0].box.min_y, 2 * (32 - 8 - 5));
  EXPECT_FLOAT_EQ(found[0].box.max_x, 2 * (32 + 10));
  EXPECT_FLOAT_EQ(found[0].box.max_y, 2 * (32 - 8 + 5));
  EXPECT_EQ(found[1].class_id, 0);
  EXPECT_FLOAT_EQ(found[1].score, 0.5F);
}

TEST_P(OnnxDetectorTest, StretchesTheImageWhenToldTo) {
  NetworkOptions options = OptionsOf(GetParam());
  options.letterbox = false;
  const auto detector = std::make_unique<NetworkDetector>(options, ClassTable({"a", "b"}));
  const std::vector<Detection> found =
      detector->Detect({0, cv::Mat(96, 128, CV_8UC3, cv::Scalar(1, 2, 3)), {}});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_FLOAT_EQ(found[0].box.min_x, 2 * (32 - 10));
  EXPECT_FLOAT_EQ(found[0].box.min_y, 1.5F * (32 - 5));
  EXPECT_FLOAT_EQ(found[0].box.max_y, 1.5F * (32 + 5));
}

TEST_P(OnnxDetectorTest, RefusesClassNamesOfAnotherNumber) {
  EXPECT_THAT(
      [] {
        NetworkDetector(OptionsOf(GetParam()), ClassTable({"a", "b", "c"}));
      },
      ThrowsMessage<InputError>(HasSubstr("1 x boxes x 8 or 1 x 7 x boxes for 3 class")));
}

TEST_P(OnnxDetectorTest, RefusesAnInputSizeThatTheNetworkHasNot) {
  NetworkOptions options = OptionsOf(GetParam());
  options.input_size = 128;
  EXPECT_THAT(
      [&] {
        NetworkDetector(options, ClassTable({"a", "b"}));
      },
      ThrowsMessage<InputError>(HasSubstr("with 1 x 128 x 128 pixels (Detector.batchSize")));
}

TEST_P(OnnxDetectorTest, LooksAtSeveralImagesAtOnce) {
  NetworkOptions options = OptionsOf(GetParam());
  options.batch_size = 3;
  NetworkDetector detector(options, ClassTable({"a", "b"}));
  const RgbdImage image{0, cv::Mat(96, 128, CV_8UC3, cv::Scalar(1, 2, 3)), {}};
  const std::vector<RgbdImage> images(3, image);
  const std::vector<std::vector<Detection>> found = detector.DetectAll(images);
  ASSERT_EQ(found.size(), 3U);
  for (const std::vector<Detection>& detections : found) {
    ASSERT_EQ(detections.size(), 2U);
    EXPECT_FLOAT_EQ(detections[0].box.min_x, 2 * (32 - 10));
    EXPECT_FLOAT_EQ(detections[1].score, 0.5F);
  }
  EXPECT_EQ(detector.Detect(image).size(), 2U) << "fewer do too";
}

TEST(OnnxInputSize, IsThatOfTheFile) {
  EXPECT_EQ(ReadOnnxInputSize(OptionsOf("yolov8").config), cv::Size(64, 64));
}

TEST(OnnxInputSize, IsNotKnownOfOtherFiles) {
  const std::filesystem::path source(SEMSLAM_SOURCE_DIR);
  EXPECT_FALSE(ReadOnnxInputSize(source / "LICENSE"));
  EXPECT_FALSE(ReadOnnxInputSize(source / "Vocabulary" / "orb.voc"));
  EXPECT_FALSE(ReadOnnxInputSize(source / "none.onnx"));
}

INSTANTIATE_TEST_SUITE_P(Forms,
                         OnnxDetectorTest,
                         ::testing::Values("yolov5", "yolov8"),
                         [](const auto& form) { return form.param; });

TEST(OnnxDetector, RefusesWhatIsNoNetwork) {
  EXPECT_THAT(
      [] {
        NetworkDetector(OptionsOf("none"), ClassTable({"a", "b"}));
      },
      ThrowsMessage<InputError>(HasSubstr("none.onnx: cannot open the network")));
  NetworkOptions options = OptionsOf("yolov5");
  const testing::TemporaryFolder folder;
  options.config = folder.path() / "text.onnx";
  std::ofstream(options.config) << "no network";
  EXPECT_THAT(
      [&] {
        NetworkDetector(options, ClassTable({"a", "b"}));
      },
      ThrowsMessage<InputError>(HasSubstr("text.onnx: OpenCV cannot read the network")));
}

TEST(NetworkOptions, RefuseABackendThatThisOpenCvHasNot) {
  NetworkOptions options = OptionsOf("yolov5");
  options.backend = "quantum";
  EXPECT_THAT(
      [&] {
        NetworkDetector(options, ClassTable({"a", "b"}));
      },
      ThrowsMessage<InputError>(HasSubstr("expected one of opencv, openvino")));
  options.backend = "opencv";
  options.target = "cuda";
  EXPECT_THAT(
      [&] {
        NetworkDetector(options, ClassTable({"a", "b"}));
      },
      ThrowsMessage<InputError>(HasSubstr("has only opencv with cpu")));
}

}  // namespace
}  // namespace semslam

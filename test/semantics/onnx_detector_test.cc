// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/semantics/onnx_detector.h"

#include <filesystem>

#include <gmock/gmock.h>

#include "semslam/base/error.h"

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
  options.input_size = 64;
  return options;
}

// make_networks.py says what these two networks always see; both say the same.
class OnnxDetectorTest : public ::testing::TestWithParam<std::string> {};

TEST_P(OnnxDetectorTest, GivesBoxesOfTheImageAndScores) {
  const auto detector = MakeNetworkDetector(OptionsOf(GetParam()), ClassTable({"a", "b"}));
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
  const auto detector = MakeNetworkDetector(options, ClassTable({"a", "b"}));
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
        OnnxDetector(OptionsOf(GetParam()), ClassTable({"a", "b", "c"}));
      },
      ThrowsMessage<InputError>(HasSubstr("1 x boxes x 8 or 1 x 7 x boxes for 3 class")));
}

TEST_P(OnnxDetectorTest, RefusesAnInputSizeThatTheNetworkHasNot) {
  NetworkOptions options = OptionsOf(GetParam());
  options.input_size = 128;
  EXPECT_THAT(
      [&] {
        OnnxDetector(options, ClassTable({"a", "b"}));
      },
      ThrowsMessage<InputError>(HasSubstr("128 x 128 pixels (Detector.inputSize)")));
}

INSTANTIATE_TEST_SUITE_P(Forms,
                         OnnxDetectorTest,
                         ::testing::Values("yolov5", "yolov8"),
                         [](const auto& form) { return form.param; });

TEST(OnnxDetector, RefusesWhatIsNoNetwork) {
  EXPECT_THAT(
      [] {
        OnnxDetector(OptionsOf("none"), ClassTable({"a", "b"}));
      },
      ThrowsMessage<InputError>(HasSubstr("none.onnx: cannot open the network")));
  NetworkOptions options = OptionsOf("yolov5");
  options.config = std::filesystem::path(SEMSLAM_SOURCE_DIR) / "LICENSE";
  EXPECT_THAT(
      [&] {
        OnnxDetector(options, ClassTable({"a", "b"}));
      },
      ThrowsMessage<InputError>(HasSubstr("LICENSE: OpenCV cannot read the network")));
}

TEST(NetworkOptions, RefuseABackendThatThisOpenCvHasNot) {
  NetworkOptions options = OptionsOf("yolov5");
  options.backend = "quantum";
  EXPECT_THAT(
      [&] {
        OnnxDetector(options, ClassTable({"a", "b"}));
      },
      ThrowsMessage<InputError>(HasSubstr("expected one of opencv, openvino")));
  options.backend = "opencv";
  options.target = "cuda";
  EXPECT_THAT(
      [&] {
        OnnxDetector(options, ClassTable({"a", "b"}));
      },
      ThrowsMessage<InputError>(HasSubstr("has only opencv with cpu")));
}

}  // namespace
}  // namespace semslam

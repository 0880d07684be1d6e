// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

#include "semslam/base/error.h"
#include "semslam/semantics/network_detector.h"

#include "semantics/darknet_config.h"

namespace semslam {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// 3x3 convolution to 4 channels with batch normalisation, 1x1 to 7, one head of one class.
const char* const kTinyNetwork = R"([net]
width=32
height=32
channels=3

[convolutional]
batch_normalize=1
filters=4
size=3
stride=2
pad=1
activation=leaky

[convolutional]
filters=6
size=1
stride=1
activation=linear

[yolo]
mask = 0
anchors = 10,14
classes=1
num=1
)";
constexpr std::uint64_t kTinyWeights = (4 * 3 * 9 + 4 * 4) + (6 * 4 + 6);

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
  return text;
}

DarknetShape Analyse(const std::string& text, std::size_t num_classes) {
  return AnalyseDarknet(DarknetConfig::FromText(text, "tiny.cfg"), num_classes);
}

TEST(DarknetConfig, CountsWeightsAndOutputs) {
  const DarknetShape shape = Analyse(kTinyNetwork, 1);
  EXPECT_EQ(shape.num_weights, kTinyWeights);
  ASSERT_EQ(shape.heads.size(), 1U);
  EXPECT_EQ(shape.heads[0].rows, 16 * 16);
  EXPECT_EQ(shape.heads[0].columns, 6);
}

TEST(DarknetConfig, NamesTheLineOfWhatDoesNotFit) {
  EXPECT_THAT([] { Analyse(kTinyNetwork, 2); },
              ThrowsMessage<InputError>(HasSubstr("tiny.cfg:20: [yolo]: classes=1, but there")));
  EXPECT_THAT([] { Analyse(Replaced(kTinyNetwork, "filters=6", "filters=7"), 1); },
              ThrowsMessage<InputError>(HasSubstr("expected 6 filters")));
  EXPECT_THAT([] { Analyse(Replaced(kTinyNetwork, "width=32", "width=33"), 1); },
              ThrowsMessage<InputError>(HasSubstr("multiples of 32")));
  EXPECT_THAT([] { Analyse(Replaced(kTinyNetwork, "filters=4", "filters=many"), 1); },
              ThrowsMessage<InputError>(HasSubstr("tiny.cfg:6")));
  EXPECT_THAT([] { Analyse(Replaced(kTinyNetwork, "[yolo]", "[region]"), 1); },
              ThrowsMessage<InputError>(HasSubstr("[region]")));
  EXPECT_THAT([] { Analyse(Replaced(kTinyNetwork, "[yolo]", "[route]\nlayers=-5\n[yolo]"), 1); },
              ThrowsMessage<InputError>(HasSubstr("no layer -5")));
  EXPECT_THAT([] { Analyse("filters=3\n", 1); }, ThrowsMessage<InputError>(HasSubstr("key=value")));
  EXPECT_THAT([] { Analyse("", 1); }, ThrowsMessage<InputError>(HasSubstr("[net]")));
}

// Finds the networks and a clip that this project may not ship.
class DarknetDetectorTest : public ::testing::Test {
 protected:
  DarknetDetectorTest()
      : data_(fs::path(SEMSLAM_SOURCE_DIR) / "../shared/data"),
        folder_(fs::path(::testing::TempDir()) /
                ::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~DarknetDetectorTest() override { fs::remove_all(folder_); }

  void SetUp() override {
    if (!fs::exists(data_ / "yolo")) {
      GTEST_SKIP() << "no networks in ../shared/data/yolo; scripts/get_models.sh fetches the like";
    }
    options_.config = data_ / "yolo/yolo-fastest-1.1.cfg";
    options_.weights = data_ / "yolo/yolo-fastest-1.1.weights";
    classes_ = ClassTable::FromFile(data_ / "yolo/coco.names");
  }

  // A copy of the weights with another length.
  fs::path WeightsOfSize(std::uintmax_t size) const {
    const fs::path copy = folder_ / "cut.weights";
    fs::copy_file(options_.weights, copy, fs::copy_options::overwrite_existing);
    fs::permissions(copy, fs::perms::owner_all);
    fs::resize_file(copy, size);
    return copy;
  }

  fs::path data_;
  fs::path folder_;
  NetworkDetector::Options options_;
  ClassTable classes_;
};

TEST_F(DarknetDetectorTest, RefusesWeightsThatAreCutShortOrTooLong) {
  const std::uintmax_t size = fs::file_size(options_.weights);
  for (const std::uintmax_t wrong : {std::uintmax_t{0}, size / 2, size - 4, size + 4}) {
    NetworkDetector::Options broken = options_;
    broken.weights = WeightsOfSize(wrong);
    EXPECT_THAT([&] { NetworkDetector(broken, classes_); },
                ThrowsMessage<InputError>(HasSubstr("cut.weights: expected")))
        << wrong;
  }
}

TEST_F(DarknetDetectorTest, RefusesFilesThatDoNotBelongTogether) {
  NetworkDetector::Options mixed = options_;
  mixed.weights = data_ / "yolo/yolo-fastest-1.1-xl.weights";
  EXPECT_THAT([&] { NetworkDetector(mixed, classes_); },
              ThrowsMessage<InputError>(HasSubstr("of another network")));
  EXPECT_THAT(
      [&] {
        NetworkDetector(options_, ClassTable({"cup", "mouse"}));
      },
      ThrowsMessage<InputError>(HasSubstr("2 class names")));
  NetworkDetector::Options missing = options_;
  missing.weights = "/nowhere/x.weights";
  EXPECT_THAT([&] { NetworkDetector(missing, classes_); },
              ThrowsMessage<InputError>(HasSubstr("/nowhere/x.weights")));
  missing.config = "/nowhere/x.cfg";
  EXPECT_THAT([&] { NetworkDetector(missing, classes_); },
              ThrowsMessage<InputError>(HasSubstr("/nowhere/x.cfg")));
}

TEST_F(DarknetDetectorTest, RunsAnImageOfAnyShapeWithinItsBorders) {
  NetworkDetector detector(options_, classes_);
  for (const auto& [width, height] : {std::pair{640, 480}, {17, 301}, {1, 1}}) {
    RgbdImage image;
    image.color = cv::Mat(height, width, CV_8UC3, cv::Scalar(30, 90, 160));
    for (const Detection& detection : detector.Detect(image)) {
      EXPECT_GE(detection.box.min_x, 0);
      EXPECT_LE(detection.box.max_x, static_cast<float>(width));
      EXPECT_LE(detection.box.max_y, static_cast<float>(height));
    }
  }
}

TEST_F(DarknetDetectorTest, SeesInSeveralImagesAtOnceWhatItSeesInEach) {
  options_.batch_size = 3;
  options_.score_threshold = 0.001F;  // Something everywhere.
  options_.min_class_score = 0.0005F;
  NetworkDetector detector(options_, classes_);
  std::vector<RgbdImage> images;
  for (int i = 0; i < 3; ++i) {
    cv::Mat picture(120, 160, CV_8UC3);
    cv::randu(picture, 0, 80 * (i + 1));
    images.push_back({i, picture, {}});
  }
  const std::vector<std::vector<Detection>> together = detector.DetectAll(images);
  ASSERT_EQ(together.size(), 3U);
  std::size_t num_found = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const std::vector<Detection> alone = detector.Detect(images[i]);
    num_found += alone.size();
    ASSERT_EQ(together[i].size(), alone.size()) << i;
    for (std::size_t k = 0; k < alone.size(); ++k) {
      EXPECT_EQ(together[i][k].class_id, alone[k].class_id);
      EXPECT_NEAR(together[i][k].score, alone[k].score, 1e-5F);
      EXPECT_NEAR(together[i][k].box.min_x, alone[k].box.min_x, 0.01F);
    }
  }
  EXPECT_GT(num_found, 0U);
}

TEST_F(DarknetDetectorTest, KnowsTheShapesOfYoloV3TinyToo) {
  const DarknetConfig config = DarknetConfig::FromFile(data_ / "yolo/yolov3-tiny.cfg");
  const DarknetShape shape = AnalyseDarknet(config, 80);
  EXPECT_EQ(shape.num_weights * 4 + 20, 35434956U);  // The published file's size.
  ASSERT_EQ(shape.heads.size(), 2U);
  const DarknetConfig full = DarknetConfig::FromFile(data_ / "yolo/yolov3.cfg");
  EXPECT_EQ(AnalyseDarknet(full, 80).num_weights * 4 + 20, 248007048U);
}

TEST_F(DarknetDetectorTest, SeesKeyboardAndMonitorOnTheDesk) {
  const char* const clips = std::getenv("SEMSLAM_CLIPS");  // NOLINT(concurrency-mt-unsafe)
  const fs::path folder = clips != nullptr ? fs::path(clips) : data_ / "clips";
  const fs::path file = folder / "fr1_xyz_160/rgb/1305031102.175304.png";
  if (!fs::exists(file)) GTEST_SKIP() << "no clip " << file << "; scripts/get_tum.sh fetches it";
  options_.config = data_ / "yolo/yolo-fastest-1.1-xl.cfg";
  options_.weights = data_ / "yolo/yolo-fastest-1.1-xl.weights";
  NetworkDetector detector(options_, classes_);
  RgbdImage image;
  image.color = cv::imread(file.string());
  ASSERT_FALSE(image.color.empty());
  const auto detections = detector.Detect(image);
  const auto overlap_with = [&](const char* name, const ImageBox& expected) {
    float best = 0;
    for (const Detection& detection : detections) {
      if (detection.class_id != classes_.Find(name)) continue;
      best = std::max(best, IntersectionOverUnion(detection.box, expected));
    }
    return best;
  };
  // Drawn by hand around the objects in this image.
  EXPECT_GT(overlap_with("keyboard", {325, 332, 585, 470}), 0.6F);
  EXPECT_GT(overlap_with("tvmonitor", {302, 112, 600, 285}), 0.5F);
}

}  // namespace
}  // namespace semslam

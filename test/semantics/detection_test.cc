// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/semantics/detection.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include <gmock/gmock.h>

#include "semslam/base/error.h"
#include "semslam/semantics/recorded_detector.h"

#include "semantics/letterbox.h"

namespace semslam {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Detection MakeDetection(int class_id, float score, const ImageBox& box) {
  Detection detection{class_id, score, box, std::vector<float>(3, 0.0F)};
  if (class_id >= 0 && class_id < 3) {
    detection.class_scores[static_cast<std::size_t>(class_id)] = score;
  }
  return detection;
}

TEST(ClassTable, FindsClassesByTheirSynonyms) {
  const ClassTable coco({"cup", "tvmonitor", "teddy bear", "mouse"});
  EXPECT_EQ(coco.Find("TV monitor"), 1);
  EXPECT_EQ(coco.Find("monitor"), 1);
  EXPECT_EQ(coco.Find("teddy_bear"), 2);
  EXPECT_EQ(coco.Find("mug"), 0);
  EXPECT_EQ(coco.Find("zebra"), std::nullopt);
  // A network whose own name is the synonym.
  EXPECT_EQ(ClassTable({"cup", "monitor"}).Find("tvmonitor"), 1);
}

TEST(ClassTable, GivesEveryClassAColourOfItsOwn) {
  std::vector<std::string> names = {"cup", "keyboard", "tvmonitor", "mouse", "teddy bear"};
  for (int i = 0; i < 75; ++i) names.push_back("thing " + std::to_string(i));
  const ClassTable table(names);
  std::set<int> colors;
  for (int i = 0; i < 80; ++i) {
    const Rgb color = table.color(i);
    colors.insert(color.r << 16 | color.g << 8 | color.b);
  }
  EXPECT_EQ(colors.size(), 80U);
  // The paper's classes look the same in every network.
  EXPECT_EQ(table.color(2), ClassTable({"monitor"}).color(0));
}

TEST(ClassTable, KeepsOnlyTheClassesOfInterest) {
  const ClassTable table = ClassTable({"cup", "tvmonitor", "dog"}).WithInterest({"monitor"});
  EXPECT_FALSE(table.is_of_interest(0));
  EXPECT_TRUE(table.is_of_interest(1));
  EXPECT_THAT([&] { static_cast<void>(table.WithInterest({"zebra"})); },
              ThrowsMessage<InputError>(HasSubstr("zebra")));
}

TEST(ClassTable, RefusesEqualAndEmptyNames) {
  EXPECT_THROW(ClassTable({"cup", "Cup"}), InputError);
  EXPECT_THROW(ClassTable({"cup", ""}), InputError);
  EXPECT_THROW(ClassTable(std::vector<std::string>{}), InputError);
  EXPECT_THROW(ClassTable::FromFile("/nowhere/names"), InputError);
}

TEST(SuppressOverlaps, KeepsTheBestOfEachClass) {
  const std::vector<Detection> kept = SuppressOverlaps(
      {MakeDetection(0, 0.5F, {0, 0, 100, 100}), MakeDetection(0, 0.9F, {5, 5, 105, 105}),
       MakeDetection(1, 0.4F, {5, 5, 105, 105}), MakeDetection(0, 0.3F, {200, 0, 300, 99})},
      0.45F);
  ASSERT_EQ(kept.size(), 3U);
  EXPECT_EQ(kept[0].score, 0.9F);
  EXPECT_EQ(kept[1].class_id, 1);
  EXPECT_EQ(kept[2].score, 0.3F);
}

TEST(ImageBox, IntersectionOverUnionIsThatOfRectangles) {
  EXPECT_FLOAT_EQ(IntersectionOverUnion({0, 0, 10, 10}, {5, 0, 15, 10}), 50.0F / 150.0F);
  EXPECT_EQ(IntersectionOverUnion({0, 0, 10, 10}, {10, 0, 20, 10}), 0.0F);
  EXPECT_EQ(IntersectionOverUnion({5, 5, 5, 5}, {5, 5, 5, 5}), 0.0F);
}

TEST(Sanitise, DropsWhatMakesNoSenseAndClipsTheRest) {
  const float nan = std::nanf("");
  const std::vector<Detection> kept =
      Sanitise({MakeDetection(0, nan, {0, 0, 10, 10}), MakeDetection(0, 0.5F, {nan, 0, 10, 10}),
                MakeDetection(7, 0.5F, {0, 0, 10, 10}), MakeDetection(-1, 0.5F, {0, 0, 10, 10}),
                MakeDetection(0, 0.5F, {900, 0, 950, 10}), MakeDetection(0, 0.5F, {30, 30, 20, 20}),
                MakeDetection(1, 7.0F, {-50, -50, 2000, 20})},
               3, 640, 480);
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept[0].score, 1.0F);
  EXPECT_EQ(kept[0].class_scores[1], 1.0F);
  EXPECT_EQ(kept[0].box.min_x, 0.0F);
  EXPECT_EQ(kept[0].box.max_x, 640.0F);
}

TEST(Sanitise, KeepsTheBestOfTenThousand) {
  std::vector<Detection> many;
  for (int i = 1; i <= 10000; ++i) {
    many.push_back(MakeDetection(0, static_cast<float>(i) * 1e-4F, {0, 0, 10, 10}));
  }
  const auto kept = Sanitise(std::move(many), 3, 640, 480, 50);
  ASSERT_EQ(kept.size(), 50U);
  EXPECT_FLOAT_EQ(kept.front().score, 1.0F);
}

TEST(Letterbox, CentresAWideImageAndMapsBoxesBack) {
  const Letterbox fit = Letterbox::Fit(640, 480, 320, 320);
  EXPECT_EQ(fit.fitted_width, 320);
  EXPECT_EQ(fit.fitted_height, 240);
  EXPECT_EQ(fit.top, 40);
  EXPECT_EQ(fit.left, 0);
  // The image's own rectangle within the input.
  const ImageBox box = fit.ToImage(0.5F, 0.5F, 1.0F, 0.75F);
  EXPECT_NEAR(box.min_x, 0, 1e-3);
  EXPECT_NEAR(box.min_y, 0, 1e-3);
  EXPECT_NEAR(box.max_x, 640, 1e-3);
  EXPECT_NEAR(box.max_y, 480, 1e-3);
}

TEST(Letterbox, CentresATallImage) {
  const Letterbox fit = Letterbox::Fit(300, 600, 416, 416);
  EXPECT_EQ(fit.fitted_width, 208);
  EXPECT_EQ(fit.fitted_height, 416);
  EXPECT_EQ(fit.left, 104);
  const ImageBox box = fit.ToImage(0.5F, 0.25F, 0.25F, 0.5F);
  EXPECT_NEAR(box.min_x, 75, 1e-3);
  EXPECT_NEAR(box.max_x, 225, 1e-3);
  EXPECT_NEAR(box.max_y, 300, 1e-3);
}

TEST(Letterbox, BlobIsRgbInTheMiddleOfGrey) {
  const cv::Mat image(50, 100, CV_8UC3, cv::Scalar(255, 51, 0));  // BGR.
  const cv::Mat blob = MakeBlob({&image, 1}, Letterbox::Fit(100, 50, 64, 64));
  const auto at = [&](int channel, int row, int column) {
    return blob.ptr<float>(0, channel, row)[column];
  };
  EXPECT_FLOAT_EQ(at(0, 32, 32), 0.0F);
  EXPECT_FLOAT_EQ(at(1, 32, 32), 0.2F);
  EXPECT_FLOAT_EQ(at(2, 32, 32), 1.0F);
  for (int channel = 0; channel < 3; ++channel) {
    EXPECT_FLOAT_EQ(at(channel, 15, 10), 0.5F);
    EXPECT_FLOAT_EQ(at(channel, 48, 10), 0.5F);
  }
}

class RecordedDetectorTest : public ::testing::Test {
 protected:
  RecordedDetectorTest()
      : folder_(std::filesystem::path(::testing::TempDir()) /
                ::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~RecordedDetectorTest() override { std::filesystem::remove_all(folder_); }

  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  RecordedDetector Load() const {
    RecordedDetector::Options options;
    options.folder = folder_;
    return RecordedDetector(options, ClassTable({"cup", "mouse", "book"}));
  }
  static RgbdImage ImageAt(TimeNs time) {
    RgbdImage image;
    image.time = time;
    image.color = cv::Mat::zeros(480, 640, CV_8UC3);
    return image;
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(RecordedDetectorTest, GivesTheBoxesOfTheImageAtThatTime) {
  Write("10.500000.txt", "1 0.5 0.5 0.25 0.5 0.8\n\n2 0.1 0.1 0.1 0.1\n");
  Write("11.000000.txt", "");
  RecordedDetector detector = Load();
  EXPECT_EQ(detector.num_images(), 2U);
  const auto detections = detector.Detect(ImageAt(10'500'000'000));
  ASSERT_EQ(detections.size(), 2U);
  EXPECT_EQ(detections[0].class_id, 2);
  EXPECT_EQ(detections[0].score, 1.0F);
  EXPECT_EQ(detections[1].class_id, 1);
  EXPECT_FLOAT_EQ(detections[1].box.min_x, 240.0F);
  EXPECT_FLOAT_EQ(detections[1].box.max_y, 360.0F);
  EXPECT_FLOAT_EQ(detections[1].class_scores[1], 0.8F);
  EXPECT_TRUE(detector.Detect(ImageAt(11'000'000'000)).empty());
  EXPECT_TRUE(detector.Detect(ImageAt(10'600'000'000)).empty());
}

TEST_F(RecordedDetectorTest, ReadsJsonToo) {
  Write("10.5.json",
        R"([{"name": "mouse", "class": 64, "confidence": 0.8,
             "box": {"x1": 240, "y1": 10.5, "x2": 300, "y2": 360}},
            {"class": 2, "box": [1, 2, 30, 40]}])");
  Write("11.0.json", "[]");
  RecordedDetector detector = Load();
  const auto detections = detector.Detect(ImageAt(10'500'000'000));
  ASSERT_EQ(detections.size(), 2U);
  EXPECT_EQ(detections[0].class_id, 2);
  EXPECT_EQ(detections[0].score, 1.0F);
  EXPECT_FLOAT_EQ(detections[0].box.max_y, 40.0F);
  EXPECT_EQ(detections[1].class_id, 1);
  EXPECT_FLOAT_EQ(detections[1].class_scores[1], 0.8F);
  EXPECT_FLOAT_EQ(detections[1].box.min_y, 10.5F);
  EXPECT_FLOAT_EQ(detections[1].box.max_x, 300.0F);
  EXPECT_TRUE(detector.Detect(ImageAt(11'000'000'000)).empty());
}

TEST_F(RecordedDetectorTest, NamesTheEntryOfBrokenJson) {
  const auto error_of = [&](const std::string& text) -> std::string {
    Write("10.5.json", text);
    try {
      Load();
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  const std::string box = R"("box": [1, 2, 30, 40])";
  EXPECT_THAT(error_of("[{"), HasSubstr("10.5.json: no JSON: byte 3"));
  EXPECT_THAT(error_of("{}"), HasSubstr("expected a list"));
  EXPECT_THAT(error_of("[7]"), HasSubstr("[0]: expected an object, found 7"));
  EXPECT_THAT(error_of(R"([{"name": "cow", )" + box + "}]"), HasSubstr("found \"cow\""));
  EXPECT_THAT(error_of(R"([{"class": 3, )" + box + "}]"), HasSubstr("a class from 0 to 2"));
  EXPECT_THAT(error_of(R"([{"class": 1, "score": 7, )" + box + "}]"), HasSubstr("score in [0, 1]"));
  EXPECT_THAT(error_of(R"([{"class": 1}])"), HasSubstr("[0]: expected box"));
  EXPECT_THAT(error_of(R"([{"class": 1, "box": {"x1": 1, "y1": 2, "x2": "3", "y2": 4}}])"),
              HasSubstr("[0]: expected box"));
}

TEST_F(RecordedDetectorTest, NamesFileAndLineOfABrokenEntry) {
  Write("10.5.txt", "1 0.5 0.5 0.25 0.5 0.8\n9 0.5 0.5 0.2 0.2 0.5\n");
  EXPECT_THAT([&] { Load(); }, ThrowsMessage<InputError>(HasSubstr("10.5.txt:2")));
  Write("10.5.txt", "1 0.5 0.5 0.25\n");
  EXPECT_THAT([&] { Load(); }, ThrowsMessage<InputError>(HasSubstr("10.5.txt:1")));
  Write("10.5.txt", "1 0.5 0.5 0.25 0.5 nan\n");
  EXPECT_THAT([&] { Load(); }, ThrowsMessage<InputError>(HasSubstr("10.5.txt:1")));
}

TEST_F(RecordedDetectorTest, RefusesFoldersWithoutDetections) {
  EXPECT_THAT([&] { Load(); }, ThrowsMessage<InputError>(HasSubstr("found none")));
  Write("frame_one.txt", "");
  EXPECT_THAT([&] { Load(); }, ThrowsMessage<InputError>(HasSubstr("frame_one.txt")));
}

}  // namespace
}  // namespace semslam

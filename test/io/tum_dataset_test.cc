// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/tum_dataset.h"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "support/clips.h"
#include "support/files.h"

namespace semslam {
namespace {

using ::testing::HasSubstr;
using testing::InputErrorOf;
using testing::ReadAll;
using testing::TemporaryFolder;

constexpr TumDataset::Options kSmall{.width = 16, .height = 12, .depth_factor = 5000.0};

std::string EncodePng(const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  cv::imencode(".png", image, bytes);
  return {bytes.begin(), bytes.end()};
}

cv::Mat NoiseImage(int type, int seed, cv::Size size = {16, 12}) {
  cv::Mat image(size, type);
  cv::RNG(seed).fill(image, cv::RNG::UNIFORM, 1, CV_MAT_DEPTH(type) == CV_16U ? 40000 : 255);
  return image;
}

// A sequence of three frames, which each test damages in its way.
class TumDatasetTest : public ::testing::Test {
 protected:
  TumDatasetTest() {
    for (int i = 1; i <= 3; ++i) {
      const std::string name = std::to_string(i) + ".png";
      folder_.Write("rgb/" + name, EncodePng(NoiseImage(CV_8UC3, i)));
      folder_.Write("depth/" + name, EncodePng(NoiseImage(CV_16UC1, 10 + i)));
    }
    WriteAssociations(
        "1.0 rgb/1.png 1.01 depth/1.png\n2.0 rgb/2.png 2.01 depth/2.png\n"
        "3.0 rgb/3.png 3.01 depth/3.png\n");
  }

  void WriteAssociations(const std::string& text) { folder_.Write("associations.txt", text); }
  std::filesystem::path associations() const { return folder_.path() / "associations.txt"; }
  TumDataset Open() const { return {folder_.path(), associations(), kSmall}; }
  std::string ErrorOfOpening(const std::string& association_text) {
    WriteAssociations(association_text);
    return InputErrorOf([&] { Open(); });
  }

  // The second frame must fail, with this text in its error; the others must not.
  std::string ErrorOfSecondFrame() {
    TumDataset dataset = Open();
    EXPECT_EQ(dataset.Next()->time, 1 * kNsPerSecond);
    const std::string text = InputErrorOf([&] { dataset.Next(); });
    const std::optional<RgbdImage> third = dataset.Next();
    EXPECT_TRUE(third && third->time == 3 * kNsPerSecond);
    EXPECT_FALSE(dataset.Next().has_value());
    return text;
  }

  TemporaryFolder folder_;
};

TEST_F(TumDatasetTest, GivesColourAsStoredAndDepthInMetres) {
  TumDataset dataset = Open();
  EXPECT_EQ(dataset.NumFrames(), 3u);
  const std::optional<RgbdImage> frame = dataset.Next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(cv::norm(frame->color, NoiseImage(CV_8UC3, 1), cv::NORM_INF), 0);
  ASSERT_EQ(frame->depth.type(), CV_32FC1);
  cv::Mat expected;
  NoiseImage(CV_16UC1, 11).convertTo(expected, CV_32F, 1 / 5000.0);
  EXPECT_LT(cv::norm(frame->depth, expected, cv::NORM_INF), 1e-6);
}

TEST_F(TumDatasetTest, MakesColourOfAGreyImage) {
  const cv::Mat grey = NoiseImage(CV_8UC1, 5);
  folder_.Write("rgb/1.png", EncodePng(grey));
  TumDataset dataset = Open();
  const RgbdImage frame = *dataset.Next();
  ASSERT_EQ(frame.color.type(), CV_8UC3);
  EXPECT_EQ(frame.color.at<cv::Vec3b>(3, 4), cv::Vec3b::all(grey.at<unsigned char>(3, 4)));
}

TEST_F(TumDatasetTest, AssociatesByNearestTimeAndUsesEachImageOnce) {
  // Colour 2 is nearer to depth 1.012 than colour 1, which then has to take what is left.
  folder_.Write("rgb.txt", "# images\n1.000 rgb/1.png\n1.011 rgb/2.png\n3.0 rgb/3.png\n");
  folder_.Write("depth.txt", "0.985 depth/1.png\n1.012 depth/2.png\n3.021 depth/3.png\n");
  const TumDataset dataset(folder_.path(), "-", kSmall);
  ASSERT_EQ(dataset.entries().size(), 2u);  // 3.0 and 3.021 are too far apart.
  EXPECT_EQ(dataset.entries()[0].color_path.filename(), "1.png");
  EXPECT_EQ(dataset.entries()[0].depth_path.filename(), "1.png");
  EXPECT_EQ(dataset.entries()[1].color_path.filename(), "2.png");
  EXPECT_EQ(dataset.entries()[1].depth_path.filename(), "2.png");
}

TEST_F(TumDatasetTest, SaysHowManyImagesFoundNoPartner) {
  folder_.Write("rgb.txt", "1.0 rgb/1.png\n");
  folder_.Write("depth.txt", "2.0 depth/1.png\n");
  EXPECT_THAT(InputErrorOf([&] { TumDataset(folder_.path(), "", kSmall); }),
              HasSubstr("no image of rgb.txt (1) is within 0.020 s of one of depth.txt (1)"));
}

TEST_F(TumDatasetTest, SaysThatTheFolderIsMissing) {
  EXPECT_EQ(InputErrorOf([&] { TumDataset("/no/such", "-", kSmall); }),
            "/no/such: expected the folder of a sequence, found nothing");
}

TEST_F(TumDatasetTest, SaysThatTheAssociationsAreMissing) {
  EXPECT_EQ(InputErrorOf([&] { TumDataset(folder_.path(), "/no/such.txt", kSmall); }),
            "/no/such.txt: cannot read: No such file or directory");
}

TEST_F(TumDatasetTest, NamesAnAssociationLineCutShort) {
  EXPECT_EQ(
      ErrorOfOpening("1.0 rgb/1.png 1.01 depth/1.png\n2.0 rgb/2.png 2.0"),
      associations().string() + ":2: expected `time color_file time depth_file`, found 3 fields");
}

TEST_F(TumDatasetTest, NamesAnAssociationTimeThatIsNoNumber) {
  EXPECT_EQ(
      ErrorOfOpening("1.0 rgb/1.png 1.01 depth/1.png\n2,0x rgb/2.png 2.0 depth/2.png\n"),
      associations().string() + ":2: expected `time color_file time depth_file`, found 5 fields");
  EXPECT_EQ(ErrorOfOpening("1.0 rgb/1.png 1.x depth/1.png\n"),
            associations().string() + ":1: expected a time in seconds, found \"1.x\"");
}

TEST_F(TumDatasetTest, NamesAnAssociatedFileThatIsNotThere) {
  EXPECT_EQ(ErrorOfOpening("# x\n1.0 rgb/9.png 1.01 depth/1.png\n"),
            associations().string() + ":2: names the image " +
                (folder_.path() / "rgb/9.png").string() + ", which is not there");
}

TEST_F(TumDatasetTest, NamesATimeThatDoesNotIncrease) {
  EXPECT_EQ(ErrorOfOpening("2.0 rgb/1.png 1.01 depth/1.png\n2.0 rgb/2.png 2.0 depth/2.png\n"),
            associations().string() +
                ":2: expected a time after that of the line before, 2.000000, found 2.000000");
}

TEST_F(TumDatasetTest, RejectsAnEmptySequence) {
  EXPECT_EQ(ErrorOfOpening("# nothing\n\n"),
            associations().string() + ": expected images, found none");
}

TEST_F(TumDatasetTest, SkipsATruncatedImageWhereverItIsCut) {
  const std::string whole = ReadAll(folder_.path() / "depth/2.png");
  for (const std::size_t percent : {10, 50, 90}) {
    folder_.Write("depth/2.png", whole.substr(0, whole.size() * percent / 100));
    EXPECT_THAT(ErrorOfSecondFrame(), HasSubstr("depth/2.png: PNG image is cut short after "));
  }
  folder_.Write("depth/2.png", whole.substr(0, whole.size() - 5));
  EXPECT_THAT(ErrorOfSecondFrame(), HasSubstr("depth/2.png: PNG image is cut short after "));
}

TEST_F(TumDatasetTest, SkipsAnImageWithAFlippedBit) {
  std::string bytes = ReadAll(folder_.path() / "rgb/2.png");
  bytes[bytes.size() / 2] ^= 0x10;
  folder_.Write("rgb/2.png", bytes);
  EXPECT_THAT(ErrorOfSecondFrame(), HasSubstr("rgb/2.png: PNG image is damaged"));
}

TEST_F(TumDatasetTest, SkipsAnEmptyFile) {
  folder_.Write("rgb/2.png", "");
  EXPECT_THAT(ErrorOfSecondFrame(), HasSubstr("expected a PNG image, found an empty file"));
}

TEST_F(TumDatasetTest, SkipsWhatIsNoPng) {
  folder_.Write("rgb/2.png", "GIF89a, perhaps, or a page that says 404");
  EXPECT_THAT(ErrorOfSecondFrame(), HasSubstr("expected a PNG image, found something else"));
}

TEST_F(TumDatasetTest, SkipsEightBitDepth) {
  folder_.Write("depth/2.png", EncodePng(NoiseImage(CV_8UC1, 1)));
  EXPECT_EQ(ErrorOfSecondFrame(),
            (folder_.path() / "depth/2.png").string() +
                ": expected 16x12, 16-bit, 1 channel, found 16x12, 8-bit, 1 channel");
}

TEST_F(TumDatasetTest, SkipsDepthWithThreeChannels) {
  folder_.Write("depth/2.png", EncodePng(NoiseImage(CV_16UC3, 1)));
  EXPECT_THAT(ErrorOfSecondFrame(), HasSubstr("found 16x12, 16-bit, 3 channels"));
}

TEST_F(TumDatasetTest, SkipsSixteenBitColour) {
  folder_.Write("rgb/2.png", EncodePng(NoiseImage(CV_16UC3, 1)));
  EXPECT_THAT(ErrorOfSecondFrame(),
              HasSubstr("expected 16x12, 8-bit, colour or grey, found 16x12, 16-bit"));
}

TEST_F(TumDatasetTest, SkipsAnImageOfWrongSize) {
  folder_.Write("rgb/2.png", EncodePng(NoiseImage(CV_8UC3, 1, {12, 16})));
  EXPECT_THAT(ErrorOfSecondFrame(),
              HasSubstr("expected 16x12, 8-bit, colour or grey, found 12x16, 8-bit, 3 channels"));
}

TEST_F(TumDatasetTest, SkipsAnImageThatVanishedAfterOpening) {
  TumDataset dataset = Open();
  std::filesystem::remove(folder_.path() / "rgb/1.png");
  EXPECT_THAT(InputErrorOf([&] { dataset.Next(); }), HasSubstr("rgb/1.png: cannot read"));
  EXPECT_EQ(dataset.Next()->time, 2 * kNsPerSecond);
}

TEST(TumDatasetOnRealClip, FindsThePairsOfTheBenchmarksOwnTool) {
  const std::filesystem::path clip = testing::FindClip("fr1_xyz_160");
  if (clip.empty()) GTEST_SKIP() << testing::kHowToGetClips;
  TumDataset dataset(clip, "-", {});
  const TumDataset from_file(clip, clip / "associations.txt", {});
  const auto pairs = [](const TumDataset& source) {
    std::set<std::pair<TimeNs, TimeNs>> result;
    for (const auto& entry : source.entries()) result.insert({entry.color_time, entry.depth_time});
    return result;
  };
  EXPECT_EQ(pairs(dataset), pairs(from_file));
  const RgbdImage frame = *dataset.Next();
  double max_depth = 0;
  cv::minMaxLoc(frame.depth, nullptr, &max_depth);
  EXPECT_GT(max_depth, 1.0);
  EXPECT_LT(max_depth, 14.0);
}

}  // namespace
}  // namespace semslam

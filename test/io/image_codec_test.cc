// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
//
// PNG and JPEG, with OpenCV's own reader and writer as the reference.
#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "semslam/io/jpeg.h"
#include "semslam/io/png_writer.h"

#include "io/png_reader.h"
#include "support/files.h"

namespace semslam {
namespace {

using semslam::testing::InputErrorOf;
using ::testing::HasSubstr;

cv::Mat NoiseImage(int type) {
  cv::Mat image(37, 53, type);
  cv::RNG random(7);
  random.fill(image, cv::RNG::UNIFORM, 0, CV_MAT_DEPTH(type) == CV_16U ? 65536 : 256);
  return image;
}

cv::Mat ReadByOpenCv(const std::string& bytes, int mode) {
  return cv::imdecode(std::vector<unsigned char>(bytes.begin(), bytes.end()), mode);
}

std::string WrittenByOpenCv(const std::string& ending, const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  EXPECT_TRUE(cv::imencode(ending, image, bytes));
  return {bytes.begin(), bytes.end()};
}

double LargestDifference(const cv::Mat& a, const cv::Mat& b) {
  return a.type() == b.type() && a.size() == b.size() ? cv::norm(a, b, cv::NORM_INF) : 1e9;
}

class EveryPngType : public ::testing::TestWithParam<int> {};

TEST_P(EveryPngType, IsReadByOpenCvAsItWas) {
  const cv::Mat image = NoiseImage(GetParam());
  for (const PngContent content : {PngContent::kPhoto, PngContent::kFlat}) {
    const std::string bytes = EncodePng(image, content);
    EXPECT_EQ(LargestDifference(ReadByOpenCv(bytes, cv::IMREAD_UNCHANGED), image), 0);
  }
}

TEST_P(EveryPngType, OfAPartOfAnImageHoldsThatPart) {
  const cv::Mat part = NoiseImage(GetParam())(cv::Rect(5, 3, 20, 10));
  const std::string bytes = EncodePng(part, PngContent::kFlat);
  EXPECT_EQ(LargestDifference(ReadByOpenCv(bytes, cv::IMREAD_UNCHANGED), part), 0);
}

INSTANTIATE_TEST_SUITE_P(PngTypes, EveryPngType, ::testing::Values(CV_8UC1, CV_8UC3, CV_16UC1));

void ExpectReadAsWritten(const cv::Mat& image) {
  for (const PngContent content : {PngContent::kPhoto, PngContent::kFlat}) {
    const std::string bytes = EncodePng(image, content);
    const cv::Mat read = ReadByOpenCv(bytes, cv::IMREAD_UNCHANGED);
    EXPECT_EQ(LargestDifference(read, image), 0);
    cv::Mat color;
    cv::cvtColor(image, color, cv::COLOR_GRAY2BGR);
    EXPECT_EQ(LargestDifference(PngReader("a", bytes).Decode(PngPixels::kBgr8), color), 0);
  }
}

TEST(PngWriter, WritesRunsOfEveryLength) {
  cv::Mat image(600, 601, CV_8UC1, cv::Scalar(90));  // A run starts where a row is flat.
  for (int row = 0; row < image.rows; ++row) image.at<std::uint8_t>(row, row + 1) = 7;
  ExpectReadAsWritten(image);
}

TEST(PngWriter, WritesPicturesOfManyBlocks) {
  cv::Mat image(700, 900, CV_8UC1);
  cv::RNG random(3);
  random.fill(image, cv::RNG::NORMAL, 128, 20);
  image.rowRange(200, 400).setTo(0);
  ExpectReadAsWritten(image);
}

TEST(PngWriter, WritesLevelsOfWhichSomeAreVeryRare) {
  // Differences 1 to 20 occur as often as Fibonacci's numbers say: codes without a limit would have
  // more than the 15 bits that fit.
  std::vector<std::uint8_t> levels = {0};
  std::vector<int> counts = {1, 1};
  while (counts.size() < 20) counts.push_back(counts[counts.size() - 1] + counts.rbegin()[1]);
  for (std::size_t step = 0; step < counts.size(); ++step) {
    for (int i = 0; i < counts[step]; ++i)
      levels.push_back(static_cast<std::uint8_t>(levels.back() + step + 1));
  }
  ExpectReadAsWritten(cv::Mat(1, static_cast<int>(levels.size()), CV_8UC1, levels.data()));
}

TEST(PngWriter, MakesNoiseAndFlatPicturesSmall) {
  cv::Mat noise(480, 640, CV_8UC1);
  cv::RNG random(3);
  random.fill(noise, cv::RNG::NORMAL, 128, 2);
  // Differences have a deviation of 2 sqrt(2): log2(2 sqrt(2) sqrt(2 pi e)) = 3.55 bits.
  EXPECT_LT(static_cast<double>(EncodePng(noise, PngContent::kPhoto).size()),
            1.02 * 3.55 / 8 * 480 * 640);
  const cv::Mat flat(480, 640, CV_16UC1, cv::Scalar(3));
  EXPECT_LT(EncodePng(flat, PngContent::kFlat).size(), 3000U);
}

class EveryColorFile : public ::testing::TestWithParam<int> {};

TEST_P(EveryColorFile, IsReadAsOpenCvReadsIt) {
  const std::string bytes = WrittenByOpenCv(".png", NoiseImage(GetParam()));
  const cv::Mat image = PngReader("a", bytes).Decode(PngPixels::kBgr8);
  EXPECT_EQ(LargestDifference(image, ReadByOpenCv(bytes, cv::IMREAD_COLOR)), 0);
}

INSTANTIATE_TEST_SUITE_P(ColorFiles,
                         EveryColorFile,
                         ::testing::Values(CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC3));

TEST(PngReader, GivesSixteenBitsAsStored) {
  const cv::Mat depth = NoiseImage(CV_16UC1);
  const std::string bytes = WrittenByOpenCv(".png", depth);
  PngReader reader("a", bytes);
  EXPECT_EQ(reader.header().bit_depth, 16);
  EXPECT_EQ(LargestDifference(reader.Decode(PngPixels::kAsStored), depth), 0);
}

TEST(PngReader, RefusesEveryFileWithAByteChanged) {
  const std::string whole = EncodePng(NoiseImage(CV_8UC1), PngContent::kPhoto);
  for (std::size_t position = 0; position + 4 < whole.size(); position += 7) {
    std::string bytes = whole;
    bytes[position] = static_cast<char>(bytes[position] ^ 0x21);
    EXPECT_THAT(InputErrorOf([&] { PngReader("a.png", bytes).Decode(PngPixels::kBgr8); }),
                HasSubstr("a.png: "))
        << position;
  }
}

TEST(PngReader, RefusesAnImageOfMoreThanACameras) {
  std::string bytes = EncodePng(cv::Mat(1, 40000, CV_8UC1, cv::Scalar(0)), PngContent::kFlat);
  EXPECT_THAT(InputErrorOf([&] { PngReader("a.png", bytes).Decode(PngPixels::kBgr8); }),
              HasSubstr("a.png: PNG image is damaged"));
}

TEST(Jpeg, ReadsWhatItWroteNearly) {
  cv::Mat image = NoiseImage(CV_8UC3);
  cv::GaussianBlur(image, image, {0, 0}, 6);
  const std::string bytes = EncodeJpeg(image);
  EXPECT_LT(LargestDifference(DecodeJpeg(bytes), image), 12);
  EXPECT_LT(LargestDifference(ReadByOpenCv(bytes, cv::IMREAD_COLOR), image), 12);
}

TEST(Jpeg, GivesNothingForWhatIsNoneOrCutShort) {
  EXPECT_TRUE(DecodeJpeg("").empty());
  EXPECT_TRUE(DecodeJpeg("no picture").empty());
  const std::string whole = EncodeJpeg(NoiseImage(CV_8UC3));
  EXPECT_TRUE(DecodeJpeg(whole.substr(0, whole.size() / 2)).empty());
}

}  // namespace
}  // namespace semslam

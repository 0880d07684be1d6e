// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/tum_recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "semslam/base/error.h"
#include "semslam/io/tum_dataset.h"

#include "support/files.h"

namespace semslam {
namespace {

using ::testing::HasSubstr;
using testing::InputErrorOf;
using testing::TemporaryFolder;

RgbdImage MakeImage(int number, int width = 64, int height = 48) {
  RgbdImage image;
  image.time = 1'795'000'000 * kNsPerSecond + number * TimeNs{33'333'000};
  cv::RNG random(static_cast<std::uint64_t>(number) + 1);
  image.color.create(height, width, CV_8UC3);
  random.fill(image.color, cv::RNG::UNIFORM, 0, 256);
  cv::Mat millimetres(height, width, CV_16UC1);
  random.fill(millimetres, cv::RNG::UNIFORM, 0, 10000);
  image.depth = DepthToMetres(millimetres, 1000);
  return image;
}

TumRecorder::Options Waiting() {
  TumRecorder::Options options;
  options.waits = true;
  return options;
}

TEST(TumRecorder, WhatIsWrittenIsReadBackToTheBit) {
  const TemporaryFolder folder;
  TumRecorder recorder(folder.path() / "clip", Waiting());
  for (int i = 0; i < 5; ++i) recorder.Add(MakeImage(i));
  const TumRecorder::Statistics statistics = recorder.Finish();
  EXPECT_EQ(statistics.num_frames, 5u);
  EXPECT_EQ(statistics.num_dropped, 0u);
  EXPECT_FALSE(statistics.error);

  TumDataset::Options options;
  options.width = 64;
  options.height = 48;
  for (const auto& associations :
       {std::filesystem::path("-"), folder.path() / "clip/associations.txt"}) {
    TumDataset dataset(folder.path() / "clip", associations, options);
    for (int i = 0; i < 5; ++i) {
      const RgbdImage expected = MakeImage(i);
      const RgbdImage image = dataset.Next().value();
      EXPECT_EQ(image.time, expected.time);
      EXPECT_EQ(cv::norm(image.color, expected.color, cv::NORM_INF), 0);
      EXPECT_LT(cv::norm(image.depth, expected.depth, cv::NORM_INF), 1e-6);
    }
    EXPECT_FALSE(dataset.Next());
  }
}

TEST(TumRecorder, AFolderWithFilesInItIsRefused) {
  const TemporaryFolder folder;
  folder.Write("rgb.txt", "");
  EXPECT_THAT(InputErrorOf([&] { TumRecorder recorder(folder.path(), {}); }),
              HasSubstr("expected a new or empty folder"));
}

TEST(TumRecorder, AnImageThatCannotBeWrittenEndsItAndIsTold) {
  const TemporaryFolder folder;
  TumRecorder recorder(folder.path() / "clip", Waiting());
  recorder.Add(MakeImage(0));
  std::filesystem::remove_all(folder.path() / "clip");
  for (int i = 1; i < 100; ++i) recorder.Add(MakeImage(i));
  const TumRecorder::Statistics statistics = recorder.Finish();
  ASSERT_TRUE(statistics.error);
  EXPECT_THAT(*statistics.error, HasSubstr((folder.path() / "clip").string()));
  EXPECT_LE(statistics.num_frames, 1u);
}

TEST(TumRecorder, FramesThatComeTooFastAreLeftOutAndCounted) {
  const TemporaryFolder folder;
  TumRecorder::Options options;
  options.queue_capacity = 2;
  TumRecorder recorder(folder.path() / "clip", options);
  const RgbdImage image = MakeImage(0, 640, 480);
  constexpr std::size_t kNumImages = 50;
  for (std::size_t i = 0; i < kNumImages; ++i) recorder.Add(image);
  const TumRecorder::Statistics statistics = recorder.Finish();
  EXPECT_GT(statistics.num_dropped, 0u);
  EXPECT_EQ(statistics.num_frames + statistics.num_dropped, kNumImages);
}

TEST(DepthFromMetres, RoundsAndLeavesOutWhatDoesNotFit) {
  const cv::Mat depth = (cv::Mat_<float>(1, 5) << 0, 1.00004F, 1.00016F, 14, -1);
  const cv::Mat values = DepthFromMetres(depth, 5000);
  const cv::Mat expected = (cv::Mat_<ushort>(1, 5) << 0, 5000, 5001, 0, 0);
  EXPECT_EQ(cv::norm(values, expected, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace semslam

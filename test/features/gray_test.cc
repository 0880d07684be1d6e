// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/gray.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace semslam {
namespace {

TEST(ToGray, GivesTheVeryValuesOfOpenCvForEveryWidth) {
  cv::RNG random(1);
  for (int width = 1; width <= 130; ++width) {
    cv::Mat color(9, width, CV_8UC3);
    random.fill(color, cv::RNG::UNIFORM, 0, 256);
    cv::Mat expected;
    cv::cvtColor(color, expected, cv::COLOR_BGR2GRAY);
    EXPECT_EQ(cv::countNonZero(ToGray(color) != expected), 0) << width;
  }
}

TEST(ToGray, ReadsAPartOfAnImage) {
  cv::Mat color(40, 200, CV_8UC3);
  cv::RNG(2).fill(color, cv::RNG::UNIFORM, 0, 256);
  const cv::Rect part(7, 5, 101, 30);
  EXPECT_EQ(cv::countNonZero(ToGray(color(part)) != ToGray(color)(part)), 0);
}

TEST(ToGray, KeepsBlackAndWhite) {
  for (const int grey : {0, 1, 254, 255}) {
    const cv::Mat color(3, 70, CV_8UC3, cv::Scalar::all(grey));
    EXPECT_EQ(cv::countNonZero(ToGray(color) != grey), 0) << grey;
  }
}

}  // namespace
}  // namespace semslam

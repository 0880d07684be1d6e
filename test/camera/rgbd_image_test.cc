// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/camera/rgbd_image.h"

#include <cstdint>
#include <stdexcept>

#include <gtest/gtest.h>

namespace semslam {
namespace {

TEST(DepthToMetres, DividesByTheFactorAndKeepsHoles) {
  const cv::Mat depth = (cv::Mat_<std::uint16_t>(1, 4) << 0, 1, 5000, 65535);
  const cv::Mat metres = DepthToMetres(depth, 5000);
  ASSERT_EQ(metres.type(), CV_32FC1);
  EXPECT_EQ(metres.at<float>(0, 0), 0.0f);
  EXPECT_FLOAT_EQ(metres.at<float>(0, 1), 0.0002f);
  EXPECT_FLOAT_EQ(metres.at<float>(0, 2), 1.0f);
  EXPECT_FLOAT_EQ(metres.at<float>(0, 3), 13.107f);
}

TEST(DepthToMetres, RefusesImagesThatAreNot16Bit) {
  EXPECT_THROW(DepthToMetres(cv::Mat::zeros(2, 2, CV_8UC1), 5000), std::logic_error);
  EXPECT_THROW(DepthToMetres(cv::Mat::zeros(2, 2, CV_16UC3), 5000), std::logic_error);
}

TEST(DepthToMetres, RefusesAFactorThatIsNotPositive) {
  const cv::Mat depth = cv::Mat::zeros(2, 2, CV_16UC1);
  EXPECT_THROW(DepthToMetres(depth, 0), std::logic_error);
  EXPECT_THROW(DepthToMetres(depth, -5000), std::logic_error);
}

}  // namespace
}  // namespace semslam

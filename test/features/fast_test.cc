// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/fast.h"

#include <ostream>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

#include "features/test_images.h"

namespace semslam {

bool operator==(const Corner& a, const Corner& b) {
  return a.x == b.x && a.y == b.y && a.response == b.response;
}
void PrintTo(const Corner& c, std::ostream* stream) {
  *stream << "(" << c.x << ", " << c.y << ") " << c.response;
}

namespace {

// The same from OpenCV: FAST of the area and its rim.
std::vector<Corner> Expected(const cv::Mat& image, const cv::Rect& area, int threshold) {
  const cv::Rect rim(area.x - kFastRadius, area.y - kFastRadius, area.width + 2 * kFastRadius,
                     area.height + 2 * kFastRadius);
  std::vector<cv::KeyPoint> keypoints;
  cv::FAST(image(rim), keypoints, threshold, true);
  std::vector<Corner> corners;
  for (const cv::KeyPoint& k : keypoints) {
    corners.push_back({static_cast<std::int16_t>(rim.x + static_cast<int>(k.pt.x)),
                       static_cast<std::int16_t>(rim.y + static_cast<int>(k.pt.y)), k.response});
  }
  return corners;
}

std::vector<Corner> Found(const cv::Mat& image, const cv::Rect& area, int threshold) {
  std::vector<Corner> corners;
  AppendFastCorners(image, area, threshold, corners);
  return corners;
}

TEST(FastCorners, AreThoseOfOpenCvAtEveryThreshold) {
  const cv::Mat image = MakeTexture(320, 240, 1);
  const cv::Rect area(3, 3, 314, 234);
  for (const int threshold : {1, 2, 5, 7, 20, 50, 100, 200, 254}) {
    EXPECT_EQ(Found(image, area, threshold), Expected(image, area, threshold)) << threshold;
  }
  EXPECT_GT(Found(image, area, 20).size(), 100u);
}

TEST(FastCorners, AreThoseOfOpenCvInNoiseOfFullContrast) {
  cv::Mat image(120, 161, CV_8UC1);
  cv::RNG random(5);
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  const cv::Rect area(3, 3, 155, 114);
  EXPECT_EQ(Found(image, area, 10), Expected(image, area, 10));
  random.fill(image, cv::RNG::UNIFORM, 0, 2);
  EXPECT_EQ(Found(255 * image, area, 20), Expected(255 * image, area, 20));
}

TEST(FastCorners, AreThoseOfOpenCvInAreasOfAnySize) {
  const cv::Mat image = MakeTexture(200, 100, 2);
  for (int width = 1; width <= 50; ++width) {
    for (const int height : {1, 2, 3, 4, 31}) {
      const cv::Rect area(3 + width, 5, width, height);
      EXPECT_EQ(Found(image, area, 7), Expected(image, area, 7)) << width << " x " << height;
    }
  }
  EXPECT_TRUE(Found(image, {10, 10, 0, 5}, 7).empty());
}

TEST(FastCorners, ReachTheBorderOfTheirArea) {
  const cv::Mat image = MakeTexture(64, 64, 3);
  const cv::Rect all(3, 3, 58, 58);
  const std::vector<Corner> corners = Found(image, all, 7);
  EXPECT_TRUE(
      std::any_of(corners.begin(), corners.end(), [](const Corner& c) { return c.x == 3; }));
  EXPECT_TRUE(
      std::any_of(corners.begin(), corners.end(), [](const Corner& c) { return c.x == 60; }));
}

TEST(FastCorners, NeedNinePixelsInARow) {
  for (const int arc : {8, 9}) {
    cv::Mat image(7, 23, CV_8UC1, cv::Scalar(100));
    std::vector<cv::Point> circle = {{0, -3}, {1, -3}, {2, -2}, {3, -1}, {3, 0},
                                     {3, 1},  {2, 2},  {1, 3},  {0, 3}};
    for (int i = 0; i < arc; ++i) image.at<std::uint8_t>(cv::Point(5, 3) + circle[i]) = 130;
    const std::vector<Corner> corners = Found(image, {5, 3, 1, 1}, 20);
    EXPECT_EQ(corners.size(), arc == 9 ? 1u : 0u);
    if (!corners.empty()) {
      EXPECT_EQ(corners.front().response, 29);
    }
  }
}

}  // namespace
}  // namespace semslam

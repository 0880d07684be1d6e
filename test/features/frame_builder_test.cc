// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/features/frame_builder.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "features/test_images.h"

namespace semslam {
namespace {

constexpr double kBf = 40;

PinholeCamera DistortedCamera() {
  return PinholeCamera({.fx = 517.3,
                        .fy = 516.5,
                        .cx = 318.6,
                        .cy = 255.3,
                        .k1 = 0.2624,
                        .k2 = -0.9531,
                        .p1 = -0.0054,
                        .p2 = 0.0026,
                        .k3 = 1.1633});
}

// Depth grows with x; no depth in the lower half.
RgbdImage MakeImage() {
  RgbdImage image;
  image.time = 123;
  cv::cvtColor(MakeTexture(640, 480, 1), image.color, cv::COLOR_GRAY2BGR);
  image.depth = cv::Mat::zeros(480, 640, CV_32F);
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 640; ++x)
      image.depth.at<float>(y, x) = 1.0F + 0.01F * static_cast<float>(x);
  }
  return image;
}

class FrameBuilderTest : public testing::Test {
 protected:
  const PinholeCamera camera_ = DistortedCamera();
  const Frame frame_ = FrameBuilder({}, camera_, kBf).Build(MakeImage());
};

TEST_F(FrameBuilderTest, KeepsTheTimeAndAllFeatures) {
  EXPECT_EQ(frame_.time, 123);
  EXPECT_EQ(frame_.keypoints.size(), 1000u);
  EXPECT_EQ(frame_.descriptors.size(), 1000u);
}

TEST_F(FrameBuilderTest, FreesPixelsFromDistortion) {
  for (const Keypoint& k : frame_.keypoints) {
    const Eigen::Vector2d raw = camera_.Distort(k.pixel.cast<double>());
    ASSERT_NEAR((raw - k.raw_pixel.cast<double>()).norm(), 0, 1e-3);
  }
}

TEST_F(FrameBuilderTest, TakesDepthAtTheRecordedPixel) {
  for (const Keypoint& k : frame_.keypoints) {
    const double expected =
        std::lround(k.raw_pixel.y()) < 240 ? 1.0 + 0.01 * std::round(k.raw_pixel.x()) : 0.0;
    ASSERT_NEAR(k.depth, expected, 1e-5) << k.raw_pixel.transpose();
  }
}

TEST_F(FrameBuilderTest, AddsTheColumnInTheVirtualRightCamera) {
  for (const Keypoint& k : frame_.keypoints) {
    if (k.has_depth()) {
      ASSERT_NEAR(k.right_x, k.pixel.x() - kBf / k.depth, 1e-3);
    } else {
      ASSERT_EQ(k.right_x, kNoRightX);
    }
  }
}

TEST_F(FrameBuilderTest, PutsEveryFeatureIntoTheGrid) {
  for (int i = 0; i < static_cast<int>(frame_.keypoints.size()); ++i) {
    const Keypoint& k = frame_.keypoints[i];
    const std::vector<int> found = frame_.grid.FindInWindow(k.pixel, 0.5F, k.octave, k.octave);
    ASSERT_NE(std::find(found.begin(), found.end(), i), found.end());
  }
}

TEST_F(FrameBuilderTest, RefusesImagesOfAnotherSize) {
  RgbdImage image = MakeImage();
  image.color = image.color.rowRange(0, 479);
  EXPECT_THROW(FrameBuilder({}, camera_, kBf).Build(image), std::logic_error);
}

TEST(FrameBuilder, TakesNonsenseForNoDepth) {
  RgbdImage image = MakeImage();
  image.depth.setTo(std::nan(""));
  image.depth.colRange(0, 320).setTo(-1.0F);
  const Frame frame = FrameBuilder({}, DistortedCamera(), kBf).Build(image);
  for (const Keypoint& k : frame.keypoints) ASSERT_EQ(k.depth, 0.0F);
}

}  // namespace
}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/texture.h"

#include <gtest/gtest.h>

#include "semslam/render/patterns.h"

namespace semslam {
namespace {

cv::Mat Ramp() {  // 4 wide, 2 high, a value of its own for each pixel.
  cv::Mat image(2, 4, CV_8UC3);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 4; ++x) image.at<cv::Vec3b>(y, x) = cv::Vec3i(10 * x, 100 * y, 7);
  }
  return image;
}

TEST(Texture, GivesTexelsAtTheirCentres) {
  const Texture texture(Ramp());
  const Eigen::Vector3f color = texture.Sample({2.5F / 4, 0.75F}, 0) * 255;  // Upper row: v near 1.
  EXPECT_NEAR(color[0], 20, 1e-3);
  EXPECT_NEAR(color[1], 0, 1e-3);
  EXPECT_NEAR(color[2], 7, 1e-3);
}

TEST(Texture, InterpolatesBetweenTexels) {
  EXPECT_NEAR(Texture(Ramp()).Sample({2.0F / 4, 0.25F}, 0)[0] * 255, 15, 1e-3);
}

TEST(Texture, RepeatsInBothDirections) {
  const Texture texture(Ramp());
  const Eigen::Vector3f inside = texture.Sample({0.3F, 0.6F}, 0);
  EXPECT_LT((texture.Sample({-2.7F, 0.6F}, 0) - inside).norm(), 1e-5);
  EXPECT_LT((texture.Sample({0.3F, 3.6F}, 0) - inside).norm(), 1e-5);
}

TEST(Texture, FromFarAwayIsItsMean) {
  const Eigen::Vector3f color = Texture(Ramp()).Sample({0.1F, 0.2F}, 4.0F) * 255;
  EXPECT_NEAR(color[0], 15, 1);
  EXPECT_NEAR(color[1], 50, 1);
}

TEST(Texture, GivesFourPlacesAsEachAlone) {
  const Texture texture(DrawCover({128, 64}, {0.2F, 0.4F, 0.6F}, 5));
  const float u[] = {0.1F, -3.7F, 5.999F, 0.5F};
  const float v[] = {0.9F, 0.001F, -0.3F, 2.25F};
  const float footprint[] = {0.001F, 0.02F, 0.3F, 7.0F};
  const Texture::Colors colors =
      texture.Sample({_mm_loadu_ps(u), _mm_loadu_ps(v), _mm_loadu_ps(footprint)});
  float green[4];
  _mm_storeu_ps(green, colors.green);
  for (int i = 0; i < 4; ++i)
    EXPECT_EQ(green[i], texture.Sample({u[i], v[i]}, footprint[i])[1]) << i;
}

TEST(Patterns, RepeatingOnesHaveNoSeam) {
  const auto step = [](const cv::Mat& image, int x0, int x1) {
    double sum = 0;
    for (int y = 0; y < image.rows; ++y) {
      sum +=
          cv::norm(cv::Vec3i(image.at<cv::Vec3b>(y, x0)) - cv::Vec3i(image.at<cv::Vec3b>(y, x1)));
    }
    return sum / image.rows;
  };
  const cv::Mat wood = DrawWood({256, 256}, {0.4F, 0.5F, 0.7F}, 1);
  double inside = 0;
  for (int x = 1; x < wood.cols; ++x) inside = std::max(inside, step(wood, x - 1, x));
  EXPECT_LE(step(wood, 255, 0), inside);
}

}  // namespace
}  // namespace semslam

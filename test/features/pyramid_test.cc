// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "features/test_images.h"

namespace semslam {
namespace {

TEST(Shrink, SamplesTheSourceAtScaledPositions) {
  // Of a plane of grey values, interpolation is exact; but for the rounding of weights and result.
  cv::Mat source(480, 640, CV_8UC1);
  const auto plane = [](double x, double y) { return 10 + 0.2 * x + 0.2 * y; };
  for (int y = 0; y < source.rows; ++y) {
    for (int x = 0; x < source.cols; ++x) {
      source.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(std::lround(plane(x, y)));
    }
  }
  const cv::Mat level = Shrink(source, LevelSize(source.size(), 1.2F), 1.2);
  ASSERT_EQ(level.size(), cv::Size(533, 400));
  for (int y = 0; y < level.rows; ++y) {
    for (int x = 0; x < level.cols; ++x) {
      ASSERT_NEAR(level.at<std::uint8_t>(y, x), plane(1.2 * x, 1.2 * y), 1.01) << x << " " << y;
    }
  }
}

// The definition, pixel by pixel.
std::uint8_t InterpolatedAt(const cv::Mat& source, double ratio, int x, int y) {
  const auto tap = [ratio](int i, int size) {
    const double position = std::min(i * ratio, size - 1.0);
    const int index = std::min(static_cast<int>(position), size - 2);
    return std::pair<int, int>(index, static_cast<int>(std::lround((position - index) * 128)));
  };
  const auto [column, u] = tap(x, source.cols);
  const auto [row, v] = tap(y, source.rows);
  int sum = 0;
  for (const int dy : {0, 1}) {
    for (const int dx : {0, 1}) {
      sum += source.at<std::uint8_t>(row + dy, column + dx) * (dx == 0 ? 128 - u : u) *
             (dy == 0 ? 128 - v : v);
    }
  }
  return static_cast<std::uint8_t>((sum + 128 * 64) >> 14);
}

TEST(Shrink, InterpolatesAlikeForEverySizeAndRatio) {
  cv::RNG random(3);
  for (const double ratio : {1.05, 1.2, 1.5, 1.99, 2.0}) {
    for (const cv::Size size :
         {cv::Size(160, 12), cv::Size(37, 20), cv::Size(9, 5), cv::Size(2, 2)}) {
      cv::Mat source(size, CV_8UC1);
      random.fill(source, cv::RNG::UNIFORM, 0, 256);
      const cv::Mat level = Shrink(source, LevelSize(size, static_cast<float>(ratio)), ratio);
      for (int y = 0; y < level.rows; ++y) {
        for (int x = 0; x < level.cols; ++x) {
          ASSERT_EQ(level.at<std::uint8_t>(y, x), InterpolatedAt(source, ratio, x, y))
              << ratio << ": " << x << ", " << y << " of " << size;
        }
      }
    }
  }
}

TEST(Shrink, KeepsAWhiteImageWhite) {
  const cv::Mat white(101, 77, CV_8UC1, cv::Scalar(255));
  const cv::Mat level = Shrink(white, LevelSize(white.size(), 1.7F), 1.7);
  EXPECT_EQ(cv::countNonZero(level != 255), 0);
}

// One pixel in double precision, borders mirrored.
double GaussianAt(const cv::Mat& image, int x, int y) {
  double sum = 0;
  double weights = 0;
  for (int v = -3; v <= 3; ++v) {
    for (int u = -3; u <= 3; ++u) {
      const double weight = std::exp(-(u * u + v * v) / 8.0);
      sum += weight * image.at<std::uint8_t>(
                          cv::borderInterpolate(y + v, image.rows, cv::BORDER_REFLECT_101),
                          cv::borderInterpolate(x + u, image.cols, cv::BORDER_REFLECT_101));
      weights += weight;
    }
  }
  return sum / weights;
}

TEST(BlurForBrief, RoundsTheGaussianToTheNearest) {
  constexpr double kTie = 0.5 + 1e-4;  // Single precision may round the wrong way at a tie.
  for (const cv::Size size : {cv::Size(320, 240), cv::Size(179, 134), cv::Size(5, 4)}) {
    const cv::Mat image = MakeTexture(size.width, size.height, 3);
    const cv::Mat blurred = BlurForBrief(image);
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x) {
        ASSERT_NEAR(blurred.at<std::uint8_t>(y, x), GaussianAt(image, x, y), kTie) << x << " " << y;
      }
    }
  }
}

// In single precision, summed as written: products and sums fused would round otherwise.
float SumOfSeven(const std::array<float, 4>& weights, const std::array<float, 7>& p) {
  return weights[0] * p[3] + weights[1] * (p[2] + p[4]) + weights[2] * (p[1] + p[5]) +
         weights[3] * (p[0] + p[6]);
}

std::array<float, 4> GaussianWeights() {
  std::array<double, 4> weights{};
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    weights[i] = std::exp(-i * i / 8.0);
    sum += (i == 0 ? 1 : 2) * weights[i];
  }
  std::array<float, 4> normalised{};
  for (int i = 0; i < 4; ++i) normalised[i] = static_cast<float>(weights[i] / sum);
  return normalised;
}

TEST(BlurForBrief, GivesTheSameBitsOnEveryProcessor) {
  cv::Mat image(2000, 2000, CV_8UC1);  // Large: few sums are so near a tie that it matters.
  cv::RNG(4).fill(image, cv::RNG::UNIFORM, 0, 256);
  const cv::Mat blurred = BlurForBrief(image);
  const std::array<float, 4> weights = GaussianWeights();
  for (int x = 3; x < image.cols - 3; ++x) {
    std::array<float, 7> rows{};  // Of the column's last seven.
    for (int y = 0; y < image.rows; ++y) {
      std::array<float, 7> pixels{};
      for (int u = 0; u < 7; ++u) pixels[u] = image.at<std::uint8_t>(y, x + u - 3);
      std::rotate(rows.begin(), rows.begin() + 1, rows.end());
      rows.back() = SumOfSeven(weights, pixels);
      if (y < 6) continue;
      ASSERT_EQ(blurred.at<std::uint8_t>(y - 3, x), std::nearbyint(SumOfSeven(weights, rows)))
          << x << " " << y;
    }
  }
}

TEST(BlurForBrief, KeepsBlackAndWhite) {
  for (const int grey : {0, 255}) {
    const cv::Mat image(50, 60, CV_8UC1, cv::Scalar(grey));
    EXPECT_EQ(cv::countNonZero(BlurForBrief(image) != grey), 0) << grey;
  }
}

}  // namespace
}  // namespace semslam

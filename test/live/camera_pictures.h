// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <gtest/gtest.h>
#include <opencv2/core/mat.hpp>

#include "semslam/camera/rgbd_image.h"

#include "live/virtual_camera.h"

namespace semslam::testing {

// What the virtual camera shows without a clip (driver/pictures.cc), where it stays far from the
// limits of colours: red counts columns, from 16 times the picture's number on, green counts rows,
// blue is 7; depth is a metre and a millimetre for each unit of red.
inline constexpr int kFirstColumn = 20;
inline constexpr int kLastColumn = 139;

inline cv::Vec3b ShownColor(int picture, int row, int column) {  // BGR.
  return {7, static_cast<uchar>(row), static_cast<uchar>(column + 16 * picture)};
}
inline float ShownDepth(int picture, int column) {
  return 0.001F * static_cast<float>(1000 + column + 16 * picture);
}

// Which of the pictures a depth image shows; it is compared as a whole by ExpectShown.
inline int ShownPicture(const RgbdImage& image) {
  const float depth = image.depth.at<float>(0, kFirstColumn);
  return static_cast<int>(std::lround(1000 * depth) - 1000 - kFirstColumn) / 16;
}

// Colours may differ by that much.
inline void ExpectShown(const RgbdImage& image, int picture, int tolerance = 0) {
  ASSERT_EQ(image.color.type(), CV_8UC3);
  ASSERT_EQ(image.depth.type(), CV_32FC1);
  for (int row = 0; row < kCameraHeight; ++row) {
    for (int column = kFirstColumn; column <= kLastColumn; ++column) {
      const cv::Vec3i difference = cv::Vec3i(image.color.at<cv::Vec3b>(row, column)) -
                                   cv::Vec3i(ShownColor(picture, row, column));
      ASSERT_LE(cv::norm(difference, cv::NORM_INF), tolerance) << row << ' ' << column;
      ASSERT_FLOAT_EQ(image.depth.at<float>(row, column), ShownDepth(picture, column));
    }
  }
}

}  // namespace semslam::testing

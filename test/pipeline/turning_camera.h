// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "pipeline/small_camera.h"

namespace semslam::testing {

// A small camera that turns on the spot in a round room of coloured squares: after a full turn it
// sees the same again. Its settings give a focal length that is 1 % too large, so that the turn
// seems 1 % too small, and there is something to be corrected when the loop is closed. All work in
// the caller's thread.
class TurningCamera : public SmallCamera {
 public:
  static constexpr int kNumFramesATurn = 60;
  static constexpr double kFocalLengthError = 1.01;
  static constexpr double kRadius = 1.6;  // Metres.

  TurningCamera() {
    cv::setNumThreads(1);
    Random random(3);
    // A pixel of the panorama is a pixel in the middle of the image. Twice around.
    const int turn = kSquare * static_cast<int>(2 * std::numbers::pi * kFocalLength / kSquare);
    pixels_a_radian_ = turn / (2 * std::numbers::pi);
    panorama_ = cv::Mat(2 * kHeight, 2 * turn, CV_8UC3);
    for (int y = 0; y < panorama_.rows; y += kSquare) {
      for (int x = 0; x < turn; x += kSquare) {
        const cv::Scalar color = RandomColor(random);
        const cv::Rect all(0, 0, panorama_.cols, panorama_.rows);
        panorama_(cv::Rect(x, y, kSquare, kSquare) & all).setTo(color);
        panorama_(cv::Rect(x + turn, y, kSquare, kSquare) & all).setTo(color);
      }
    }
    LookForward();
  }

  RgbdImagePtr Image(int number) const {
    const double angle = 2 * std::numbers::pi * (number % kNumFramesATurn) / kNumFramesATurn;
    cv::Mat color;
    cv::remap(panorama_, color, column_ + pixels_a_radian_ * angle, row_, cv::INTER_LINEAR);
    return std::make_shared<const RgbdImage>(
        RgbdImage{FromSeconds(number / 30.0), color, depth_.clone()});
  }

  static Settings MakeSettings() {
    return SmallCamera::MakeSettings(kFocalLength * kFocalLengthError, 80, 600);
  }

  std::shared_ptr<const Vocabulary> Train() const {
    std::vector<RgbdImagePtr> images;
    for (int number = 0; number < kNumFramesATurn; number += 10) images.push_back(Image(number));
    return SmallCamera::Train(MakeSettings(), images, 8);
  }

 private:
  // Where each pixel's ray meets the wall when the camera looks along the first column.
  void LookForward() {
    column_ = cv::Mat(kHeight, kWidth, CV_32FC1);
    row_ = cv::Mat(kHeight, kWidth, CV_32FC1);
    depth_ = cv::Mat(kHeight, kWidth, CV_32FC1);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const double ray_x = (x - 0.5 * (kWidth - 1)) / kFocalLength;
        const double ray_y = (y - 0.5 * (kHeight - 1)) / kFocalLength;
        const double share = 1 / std::sqrt(1 + ray_x * ray_x);
        const double turn_pixels =
            0.25 * panorama_.cols;  // Half a turn in, for what is left of it.
        column_.at<float>(y, x) =
            static_cast<float>(turn_pixels + pixels_a_radian_ * std::atan(ray_x));
        row_.at<float>(y, x) = static_cast<float>(kHeight + pixels_a_radian_ * ray_y * share);
        depth_.at<float>(y, x) = static_cast<float>(kRadius * share);
      }
    }
  }

  double pixels_a_radian_ = 0;
  cv::Mat panorama_;
  cv::Mat column_;
  cv::Mat row_;
  cv::Mat depth_;
};

}  // namespace semslam::testing

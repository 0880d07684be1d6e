// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include <opencv2/core.hpp>

#include "pipeline/small_camera.h"

namespace semslam::testing {

// A small camera that glides along a wall of coloured squares, a whole number of pixels a frame:
// images that cost nothing, and whose truth is exact. All work in the caller's thread.
class WallCamera : public SmallCamera {
 public:
  static constexpr int kStep = 6;        // Pixels a frame.
  static constexpr double kDepth = 1.3;  // Metres.

  explicit WallCamera(int num_frames) {
    cv::setNumThreads(1);
    Random random(3);
    wall_ = cv::Mat(kHeight, kWidth + kStep * num_frames, CV_8UC3);
    for (int y = 0; y < wall_.rows; y += kSquare) {
      for (int x = 0; x < wall_.cols; x += kSquare) {
        const cv::Rect square =
            cv::Rect(x, y, kSquare, kSquare) & cv::Rect(0, 0, wall_.cols, wall_.rows);
        wall_(square).setTo(RandomColor(random));
      }
    }
  }

  RgbdImagePtr Image(int number) const {
    const cv::Rect view(kStep * number, 0, kWidth, kHeight);
    return std::make_shared<const RgbdImage>(
        RgbdImage{FromSeconds(number / 30.0), wall_(view).clone(),
                  cv::Mat(kHeight, kWidth, CV_32FC1, cv::Scalar(kDepth))});
  }
  static RgbdImagePtr Blank(int number) {
    return std::make_shared<const RgbdImage>(
        RgbdImage{FromSeconds(number / 30.0), cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar(0)),
                  cv::Mat(kHeight, kWidth, CV_32FC1, cv::Scalar(0))});
  }
  static Eigen::Vector3d Position(int number) {
    return {number * kStep * kDepth / kFocalLength, 0, 0};
  }

  static Settings MakeSettings() { return SmallCamera::MakeSettings(kFocalLength, 20, 300); }

  std::shared_ptr<const Vocabulary> Train() const {
    return SmallCamera::Train(MakeSettings(), {Image(0), Image(8), Image(16)}, 6);
  }

 private:
  cv::Mat wall_;
};

}  // namespace semslam::testing

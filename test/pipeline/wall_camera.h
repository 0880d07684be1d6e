// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include <opencv2/core.hpp>

#include "semslam/base/random.h"
#include "semslam/camera/rgbd_image.h"
#include "semslam/config/settings.h"
#include "semslam/features/frame_builder.h"
#include "semslam/place/vocabulary_training.h"

namespace semslam::testing {

// A small camera that glides along a wall of coloured squares, a whole number of pixels a frame:
// images that cost nothing, and whose truth is exact. All work in the caller's thread.
class WallCamera {
 public:
  static constexpr int kWidth = 320;
  static constexpr int kHeight = 240;
  static constexpr int kStep = 6;  // Pixels a frame.
  static constexpr double kFocalLength = 260;
  static constexpr double kDepth = 1.3;  // Metres.

  explicit WallCamera(int num_frames) {
    cv::setNumThreads(1);
    constexpr int kSquare = 7;
    Random random(3);
    wall_ = cv::Mat(kHeight, kWidth + kStep * num_frames, CV_8UC3);
    for (int y = 0; y < wall_.rows; y += kSquare) {
      for (int x = 0; x < wall_.cols; x += kSquare) {
        const cv::Rect square =
            cv::Rect(x, y, kSquare, kSquare) & cv::Rect(0, 0, wall_.cols, wall_.rows);
        const auto value = static_cast<double>(random.Index(200));
        wall_(square).setTo(cv::Scalar(value, value + 20, value + 40));
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

  static Settings MakeSettings() {
    Settings settings;
    settings.camera = {.width = kWidth,
                       .height = kHeight,
                       .fx = kFocalLength,
                       .fy = kFocalLength,
                       .cx = 0.5 * (kWidth - 1),
                       .cy = 0.5 * (kHeight - 1)};
    settings.bf = 20;
    settings.orb.num_features = 300;
    settings.orb.num_levels = 4;
    settings.tracking.min_features_to_start = 100;
    settings.tracking.keyframes.changed_ratio = 0.9;
    settings.tracking.keyframes.changed_ratio_at_start = 0.9;
    settings.cloud.pixel_stride = 8;
    settings.voxels.voxel_size = 0.05;
    settings.segmentation.num_threads = 1;
    return settings;
  }

  std::shared_ptr<const Vocabulary> Train() const {
    const Settings settings = MakeSettings();
    const FrameBuilder builder(settings.orb, PinholeCamera(settings.camera), settings.bf);
    std::vector<std::vector<Descriptor>> images;
    for (const int number : {0, 8, 16}) images.push_back(builder.Build(*Image(number)).descriptors);
    return std::make_shared<const Vocabulary>(
        TrainVocabulary(images, {.branching = 6, .depth = 3, .max_iterations = 4}, 1));
  }

 private:
  cv::Mat wall_;
};

}  // namespace semslam::testing

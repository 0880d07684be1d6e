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

// What the small cameras of these tests have in common: walls of coloured squares, images of a
// quarter of the usual size, and one thread.
struct SmallCamera {
  static constexpr int kWidth = 320;
  static constexpr int kHeight = 240;
  static constexpr double kFocalLength = 260;
  static constexpr int kSquare = 7;  // Pixels.

  static cv::Scalar RandomColor(Random& random) {
    const auto value = static_cast<double>(random.Index(200));
    return {value, value + 20, value + 40};
  }

  static Settings MakeSettings(double focal_length, double bf, int num_features) {
    Settings settings;
    settings.camera = {.width = kWidth,
                       .height = kHeight,
                       .fx = focal_length,
                       .fy = focal_length,
                       .cx = 0.5 * (kWidth - 1),
                       .cy = 0.5 * (kHeight - 1)};
    settings.bf = bf;
    settings.orb.num_features = num_features;
    settings.orb.num_levels = 4;
    settings.tracking.min_features_to_start = 100;
    settings.tracking.keyframes.changed_ratio = 0.9;
    settings.tracking.keyframes.changed_ratio_at_start = 0.9;
    settings.cloud.pixel_stride = 8;
    settings.voxels.voxel_size = 0.05;
    settings.segmentation.num_threads = 1;
    return settings;
  }

  static std::shared_ptr<const Vocabulary> Train(const Settings& settings,
                                                 const std::vector<RgbdImagePtr>& images,
                                                 int branching) {
    const FrameBuilder builder(settings.orb, PinholeCamera(settings.camera), settings.bf);
    std::vector<std::vector<Descriptor>> descriptors;
    for (const RgbdImagePtr& image : images) {
      descriptors.push_back(builder.Build(*image).descriptors);
    }
    return std::make_shared<const Vocabulary>(
        TrainVocabulary(descriptors, {.branching = branching, .depth = 3, .max_iterations = 4}, 1));
  }
};

}  // namespace semslam::testing

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/features/frame_builder.h"

#include <algorithm>
#include <cmath>

#include "semslam/base/check.h"

#include "features/gray.h"

namespace semslam {
namespace {

// Depth of the nearest pixel; 0 where there is none or nonsense.
float DepthAt(const cv::Mat& depth, const Eigen::Vector2f& pixel) {
  const int x = std::clamp(static_cast<int>(std::lround(pixel.x())), 0, depth.cols - 1);
  const int y = std::clamp(static_cast<int>(std::lround(pixel.y())), 0, depth.rows - 1);
  const float z = depth.at<float>(y, x);
  return std::isfinite(z) && z > 0 ? z : 0;
}

}  // namespace

FrameBuilder::FrameBuilder(OrbExtractor::Options options,
                           const PinholeCamera& camera,
                           double baseline_times_fx)
    : extractor_(options), camera_(camera), baseline_times_fx_(baseline_times_fx) {
  SEMSLAM_CHECK(std::isfinite(baseline_times_fx) && baseline_times_fx > 0)
      << "baseline_times_fx = " << baseline_times_fx;
}

Frame FrameBuilder::Build(const RgbdImage& image) const {
  const cv::Size size(camera_.width(), camera_.height());
  SEMSLAM_CHECK(image.color.type() == CV_8UC3 && image.color.size() == size)
      << "colour " << image.color.cols << "x" << image.color.rows << ", type "
      << image.color.type();
  SEMSLAM_CHECK(image.depth.type() == CV_32FC1 && image.depth.size() == size)
      << "depth " << image.depth.cols << "x" << image.depth.rows << ", type " << image.depth.type();

  OrbFeatures features = extractor_.Extract(ToGray(image.color));
  Frame frame;
  frame.time = image.time;
  frame.descriptors = std::move(features.descriptors);
  frame.keypoints.reserve(features.keypoints.size());
  for (const OrbFeatures::Keypoint& feature : features.keypoints) {
    Keypoint& keypoint = frame.keypoints.emplace_back();
    keypoint.raw_pixel = feature.pixel;
    keypoint.pixel = camera_.Undistort(feature.pixel.cast<double>()).cast<float>();
    keypoint.angle = feature.angle;
    keypoint.octave = feature.octave;
    keypoint.response = feature.response;
    keypoint.depth = DepthAt(image.depth, feature.pixel);
    if (keypoint.has_depth()) {
      keypoint.right_x =
          keypoint.pixel.x() - static_cast<float>(baseline_times_fx_ / keypoint.depth);
    }
  }
  frame.grid = FeatureGrid(frame.keypoints, camera_.ideal_bounds());
  return frame;
}

}  // namespace semslam

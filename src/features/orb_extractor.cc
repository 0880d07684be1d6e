// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/features/orb_extractor.h"

#include <cmath>
#include <numbers>

#include "semslam/base/check.h"

#include "features/brief.h"
#include "features/corners.h"
#include "features/orientation.h"
#include "features/pyramid.h"

namespace semslam {
namespace {

// Corners keep this distance from the border, so that disc and pattern fit at any angle.
constexpr int kEdge = SteeredBrief::kReach + 1;
static_assert(kEdge > IntensityCentroid::kRadius);

// The wanted number falls by the scale factor from level to level; the last one gets the rest.
std::vector<int> ShareAmongLevels(const OrbExtractor::Options& options) {
  const double ratio = 1.0 / options.scale_factor;
  double share = options.num_features * (1 - ratio) / (1 - std::pow(ratio, options.num_levels));
  std::vector<int> shares;
  int num_left = options.num_features;
  for (int level = 0; level + 1 < options.num_levels; ++level) {
    shares.push_back(std::min(static_cast<int>(std::lround(share)), num_left));
    num_left -= shares.back();
    share *= ratio;
  }
  shares.push_back(num_left);
  return shares;
}

// Orientation and descriptor of the corners of one level.
void AppendFeatures(const cv::Mat& image,
                    const std::vector<Corner>& corners,
                    int octave,
                    float scale,
                    OrbFeatures& features) {
  if (corners.empty()) return;
  const IntensityCentroid centroid;
  const SteeredBrief brief;
  const cv::Mat blurred = BlurForBrief(image);
  for (const Corner& c : corners) {
    const float angle = centroid.AngleDegrees(image, c.x, c.y);
    features.keypoints.push_back({.pixel = Eigen::Vector2f(c.x, c.y) * scale,
                                  .angle = angle * static_cast<float>(std::numbers::pi / 180),
                                  .octave = static_cast<std::int16_t>(octave),
                                  .response = c.response});
    features.descriptors.push_back(brief.Describe(blurred, c.x, c.y, angle));
  }
}

}  // namespace

void OrbExtractor::Options::Validate() const {
  SEMSLAM_CHECK(num_features > 0) << "num_features = " << num_features;
  SEMSLAM_CHECK(scale_factor > 1 && scale_factor <= 2) << "scale_factor = " << scale_factor;
  SEMSLAM_CHECK(num_levels >= 1 && num_levels <= 32) << "num_levels = " << num_levels;
  SEMSLAM_CHECK(min_fast_threshold >= 1) << "min_fast_threshold = " << min_fast_threshold;
  SEMSLAM_CHECK(min_fast_threshold <= initial_fast_threshold && initial_fast_threshold <= 255)
      << "fast thresholds " << initial_fast_threshold << ", " << min_fast_threshold;
}

OrbExtractor::OrbExtractor(Options options) : options_(options) {
  options_.Validate();
  features_per_level_ = ShareAmongLevels(options_);
  float scale = 1;
  for (int level = 0; level < options_.num_levels; ++level) {
    scale_factors_.push_back(scale);
    scale *= options_.scale_factor;
  }
}

OrbFeatures OrbExtractor::Extract(const cv::Mat& gray) const {
  SEMSLAM_CHECK(gray.type() == CV_8UC1) << "type " << gray.type();
  SEMSLAM_CHECK(gray.cols < 32768 && gray.rows < 32768) << gray.cols << "x" << gray.rows;
  OrbFeatures features;
  features.keypoints.reserve(options_.num_features);
  features.descriptors.reserve(options_.num_features);
  cv::Mat image = gray;
  for (int level = 0; level < options_.num_levels; ++level) {
    const cv::Size size = LevelSize(gray.size(), scale_factors_[level]);
    if (std::min(size.width, size.height) <= 2 * kEdge) break;
    if (level > 0) image = Shrink(image, size, options_.scale_factor);
    const cv::Rect region(kEdge, kEdge, size.width - 2 * kEdge, size.height - 2 * kEdge);
    const std::vector<Corner> corners = SpreadCorners(
        DetectCorners(image, kEdge, options_.initial_fast_threshold, options_.min_fast_threshold),
        region, features_per_level_[level]);
    AppendFeatures(image, corners, level, scale_factors_[level], features);
  }
  return features;
}

}  // namespace semslam

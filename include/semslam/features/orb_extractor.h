// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "semslam/features/descriptor.h"

namespace semslam {

// Features of one image; keypoints[i] and descriptors[i] belong together. Sorted by octave.
struct OrbFeatures {
  struct Keypoint {
    Eigen::Vector2f pixel;    // In the full image.
    float angle = 0;          // Radians in [0, 2 pi), from the x axis to the y axis.
    std::int16_t octave = 0;  // Pyramid level.
    float response = 0;       // FAST score: the highest threshold at which this is a corner.
  };
  std::vector<Keypoint> keypoints;
  std::vector<Descriptor> descriptors;
};

// ORB features (Rublee et al. 2011) spread evenly over image and scales (Mur-Artal et al.,
// "ORB-SLAM", 2015, section IV.B). Immutable: threads may share one. Works in the caller's thread
// alone; the same image gives the same features everywhere.
class OrbExtractor {
 public:
  struct Options {
    int num_features = 1000;          // Wanted in all; poor images give fewer.
    float scale_factor = 1.2F;        // Between the levels of the pyramid; > 1.
    int num_levels = 8;               // 1 ... 32.
    int initial_fast_threshold = 20;  // Grey values.
    int min_fast_threshold = 7;       // Where the first one finds nothing; 1 ... the first one.

    // Throws std::logic_error if a value is out of its range.
    void Validate() const;
  };

  explicit OrbExtractor(Options options);

  // `gray` is CV_8UC1 of any size; one too small for the patch of a feature gives none.
  OrbFeatures Extract(const cv::Mat& gray) const;

  const Options& options() const { return options_; }
  // Size of a pixel of each level in pixels of the full image: 1, s, s^2, ...
  const std::vector<float>& scale_factors() const { return scale_factors_; }

 private:
  Options options_;
  std::vector<float> scale_factors_;
  std::vector<int> features_per_level_;
};

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include <opencv2/core/mat.hpp>

#include "semslam/features/descriptor.h"

namespace semslam {

// ORB's descriptor: 256 comparisons of pixels of a blurred image, turned by the keypoint's angle.
class SteeredBrief {
 public:
  // The turned pattern stays within this distance of the keypoint.
  static constexpr int kReach = 18;

  SteeredBrief();

  // `blurred` is the level of the pyramid after BlurForBrief; (x, y) lies >= kReach from its
  // border.
  Descriptor Describe(const cv::Mat& blurred, int x, int y, float angle_degrees) const;

 private:
  static constexpr int kNumPoints = 2 * kDescriptorBits;
  // All first positions, then all second ones.
  std::array<float, kNumPoints> pattern_x_{};
  std::array<float, kNumPoints> pattern_y_{};
};

}  // namespace semslam

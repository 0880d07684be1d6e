// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/brief.h"

#include <cmath>
#include <cstdint>

#include <opencv2/core.hpp>

#include "features/orb_pattern.h"

namespace semslam {

SteeredBrief::SteeredBrief() : pattern_x_{}, pattern_y_{} {
  for (int i = 0; i < kDescriptorBits; ++i) {
    const BriefPair& pair = OrbPattern()[i];
    pattern_x_[i] = pair.first_x;
    pattern_y_[i] = pair.first_y;
    pattern_x_[kDescriptorBits + i] = pair.second_x;
    pattern_y_[kDescriptorBits + i] = pair.second_y;
  }
}

Descriptor SteeredBrief::Describe(const cv::Mat& blurred, int x, int y, float angle_degrees) const {
  const float angle = angle_degrees * static_cast<float>(CV_PI / 180.F);
  const float cosine = std::cos(angle);
  const float sine = std::sin(angle);
  const int step = static_cast<int>(blurred.step);
  const std::uint8_t* center = blurred.ptr<std::uint8_t>(y) + x;

  std::array<std::uint8_t, kNumPoints> values;
  for (int i = 0; i < kNumPoints; ++i) {
    const int u = cvRound(pattern_x_[i] * cosine - pattern_y_[i] * sine);
    const int v = cvRound(pattern_x_[i] * sine + pattern_y_[i] * cosine);
    values[i] = center[v * step + u];
  }
  Descriptor descriptor;
  for (int i = 0; i < kDescriptorBits; ++i) {
    const std::uint64_t bit = values[i] < values[kDescriptorBits + i];
    descriptor.bits[i / 64] |= bit << (i % 64);
  }
  return descriptor;
}

}  // namespace semslam

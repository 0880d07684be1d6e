// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/brief.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include <opencv2/core.hpp>

#include "semslam/base/simd_clones.h"

#include "features/orb_pattern.h"

namespace semslam {
namespace {

constexpr int kWordBits = 64;

// To the nearest integer, ties to even, as cvRound does: adding 1.5 * 2^23 leaves it in the low
// bits.
SEMSLAM_SIMD_INLINE std::int32_t RoundToNearest(float value) {
  constexpr float kShift = 12582912.0F;
  return std::bit_cast<std::int32_t>(value + kShift) - std::bit_cast<std::int32_t>(kShift);
}

}  // namespace

SteeredBrief::SteeredBrief() {
  for (int i = 0; i < kDescriptorBits; ++i) {
    const BriefPair& pair = OrbPattern()[i];
    pattern_x_[i] = pair.first_x;
    pattern_y_[i] = pair.first_y;
    pattern_x_[kDescriptorBits + i] = pair.second_x;
    pattern_y_[kDescriptorBits + i] = pair.second_y;
  }
}

SEMSLAM_SIMD_CLONES Descriptor SteeredBrief::Describe(const cv::Mat& blurred,
                                                      int x,
                                                      int y,
                                                      float angle_degrees) const {
  const float angle = angle_degrees * static_cast<float>(CV_PI / 180.F);
  const float cosine = std::cos(angle);
  const float sine = std::sin(angle);
  const int step = static_cast<int>(blurred.step);
  const std::uint8_t* center = blurred.ptr<std::uint8_t>(y) + x;

  // Two plain passes, so that the compiler can do the first with vectors.
  std::array<std::int32_t, kNumPoints> offsets;
  for (int i = 0; i < kNumPoints; ++i) {
    const int u = RoundToNearest(pattern_x_[i] * cosine - pattern_y_[i] * sine);
    const int v = RoundToNearest(pattern_x_[i] * sine + pattern_y_[i] * cosine);
    offsets[i] = v * step + u;
  }
  Descriptor descriptor;
  for (int word = 0; word < kDescriptorBits / kWordBits; ++word) {
    const std::int32_t* first = offsets.data() + word * kWordBits;
    const std::int32_t* second = first + kDescriptorBits;
    std::uint64_t bits = 0;
    // A comparison leaves its result in the carry, which the sum takes in.
#pragma GCC unroll 16
    for (int i = kWordBits - 1; i >= 0; --i) {
      bits += bits + (center[first[i]] < center[second[i]] ? 1 : 0);
    }
    descriptor.bits[word] = bits;
  }
  return descriptor;
}

}  // namespace semslam

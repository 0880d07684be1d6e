// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/brief.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <opencv2/core.hpp>

#include "features/orb_pattern.h"
#include "features/simd_clones.h"

namespace semslam {
namespace {

// To the nearest integer, ties to even, as cvRound does: adding 1.5 * 2^23 leaves it in the low
// bits.
std::int32_t RoundToNearest(float value) {
  constexpr float kShift = 12582912.0F;
  return std::bit_cast<std::int32_t>(value + kShift) - std::bit_cast<std::int32_t>(kShift);
}

// Eight bytes 0 or 1 to the eight bits of a byte, the first one lowest.
std::uint64_t PackBits(const std::uint8_t* bits) {
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, bits, 8);
  return (bytes * 0x0102040810204080) >> 56;
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

  // Three plain passes, so that the compiler can do the first and the last with vectors.
  std::array<std::int32_t, kNumPoints> offsets;
  for (int i = 0; i < kNumPoints; ++i) {
    const int u = RoundToNearest(pattern_x_[i] * cosine - pattern_y_[i] * sine);
    const int v = RoundToNearest(pattern_x_[i] * sine + pattern_y_[i] * cosine);
    offsets[i] = v * step + u;
  }
  std::array<std::uint8_t, kNumPoints> values;
  for (int i = 0; i < kNumPoints; ++i) values[i] = center[offsets[i]];
  std::array<std::uint8_t, kDescriptorBits> bits;
  for (int i = 0; i < kDescriptorBits; ++i) bits[i] = values[i] < values[kDescriptorBits + i];
  Descriptor descriptor;
  for (int byte = 0; byte < kDescriptorBits / 8; ++byte) {
    descriptor.bits[byte / 8] |= PackBits(&bits[8 * byte]) << (8 * (byte % 8));
  }
  return descriptor;
}

}  // namespace semslam

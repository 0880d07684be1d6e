// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/orientation.h"

#include <cmath>

#include <opencv2/core.hpp>

#include "semslam/base/simd_clones.h"

namespace semslam {

namespace {

using HalfWidths = std::array<int, IntensityCentroid::kRadius + 1>;

// Of the disc's row at distance v from the centre.
HalfWidths DiscHalfWidths() {
  constexpr int kRadius = IntensityCentroid::kRadius;
  // Rows up to 45 degrees from the circle's equation, the others by mirroring at the diagonal, so
  // that the disc looks the same along both axes.
  HalfWidths half_widths{};
  const int diagonal = static_cast<int>(std::floor(kRadius * std::sqrt(0.5) + 1));
  for (int v = 0; v <= diagonal; ++v) {
    half_widths[v] = static_cast<int>(std::lround(std::sqrt(kRadius * kRadius - v * v)));
  }
  int u = 0;
  for (int v = kRadius; v >= static_cast<int>(std::ceil(kRadius * std::sqrt(0.5))); --v) {
    while (half_widths[u] == half_widths[u + 1]) ++u;
    half_widths[v] = u++;
  }
  return half_widths;
}

}  // namespace

IntensityCentroid::IntensityCentroid() {
  const HalfWidths half_widths = DiscHalfWidths();
  for (int v = 0; v <= kRadius; ++v) {
    for (int u = -half_widths[v]; u <= half_widths[v]; ++u) masks_[v][kRadius + u] = 255;
  }
}

// First the sums of each column, weighted with the rows' positions and plain, all columns at once:
// both fit into 16 bits.
SEMSLAM_SIMD_CLONES IntensityCentroid::Moments IntensityCentroid::MomentsAt(
    const std::uint8_t* center, std::ptrdiff_t step) const {
  static_assert(255 * kRadius * (kRadius + 1) / 2 <= 32767 && 255 * (2 * kRadius + 1) <= 32767);
  std::array<std::int16_t, kRow> sums;
  std::array<std::int16_t, kRow> weighted{};
  const std::uint8_t* row = center - kRadius;
  for (int i = 0; i < kRow; ++i) sums[i] = static_cast<std::int16_t>(row[i] & masks_[0][i]);
  for (int v = 1; v <= kRadius; ++v) {
    const std::uint8_t* above = row - v * step;
    const std::uint8_t* below = row + v * step;
    for (int i = 0; i < kRow; ++i) {
      const int a = above[i] & masks_[v][i];
      const int b = below[i] & masks_[v][i];
      sums[i] = static_cast<std::int16_t>(sums[i] + a + b);
      weighted[i] = static_cast<std::int16_t>(weighted[i] + v * (b - a));
    }
  }
  Moments moments;
  for (int i = 0; i < kRow; ++i) {
    moments.x += (i - kRadius) * sums[i];
    moments.y += weighted[i];
  }
  return moments;
}

float IntensityCentroid::AngleDegrees(const cv::Mat& image, int x, int y) const {
  const Moments moments =
      MomentsAt(image.ptr<std::uint8_t>(y) + x, static_cast<std::ptrdiff_t>(image.step));
  return cv::fastAtan2(static_cast<float>(moments.y), static_cast<float>(moments.x));
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/orientation.h"

#include <cmath>

#include <opencv2/core.hpp>

namespace semslam {

IntensityCentroid::IntensityCentroid() {
  // Rows up to 45 degrees from the circle's equation, the others by mirroring at the diagonal, so
  // that the disc looks the same along both axes.
  const int diagonal = static_cast<int>(std::floor(kRadius * std::sqrt(0.5) + 1));
  for (int v = 0; v <= diagonal; ++v) {
    half_widths_[v] = static_cast<int>(std::lround(std::sqrt(kRadius * kRadius - v * v)));
  }
  int u = 0;
  for (int v = kRadius; v >= static_cast<int>(std::ceil(kRadius * std::sqrt(0.5))); --v) {
    while (half_widths_[u] == half_widths_[u + 1]) ++u;
    half_widths_[v] = u++;
  }
}

float IntensityCentroid::AngleDegrees(const cv::Mat& image, int x, int y) const {
  const auto step = static_cast<std::ptrdiff_t>(image.step);
  const std::uint8_t* center = image.ptr<std::uint8_t>(y) + x;
  int moment_x = 0;
  int moment_y = 0;
  for (int u = -kRadius; u <= kRadius; ++u) moment_x += u * center[u];
  for (int v = 1; v <= kRadius; ++v) {
    const std::uint8_t* above = center - v * step;
    const std::uint8_t* below = center + v * step;
    int difference = 0;
    for (int u = -half_widths_[v]; u <= half_widths_[v]; ++u) {
      moment_x += u * (above[u] + below[u]);
      difference += below[u] - above[u];
    }
    moment_y += v * difference;
  }
  return cv::fastAtan2(static_cast<float>(moment_y), static_cast<float>(moment_x));
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/segment_color.h"

#include <algorithm>
#include <cmath>

namespace semslam {

Rgb SegmentColor(std::uint32_t id) {
  if (id == 0) return {88, 90, 94};
  const std::uint32_t mixed = id * 2654435761U;
  const double hue = std::fmod(id * 0.61803398875, 1.0) * 6.0;
  const double saturation = 0.55 + 0.15 * (mixed >> 8 & 3) / 1.5;
  const double value = 0.75 + 0.25 * (mixed >> 20 & 3) / 3.0;
  const auto channel = [&](double offset) {
    const double k = std::fmod(offset + hue, 6.0);
    const double level = value * (1.0 - saturation * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0));
    return static_cast<std::uint8_t>(std::lround(255.0 * level));
  };
  return {channel(5), channel(3), channel(1)};
}

}  // namespace semslam

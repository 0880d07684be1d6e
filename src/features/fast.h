// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace semslam {

// A FAST corner on a level of the pyramid.
struct Corner {
  std::int16_t x = 0;
  std::int16_t y = 0;
  float response = 0;  // The highest threshold at which it is a corner.
};

// FAST looks at a circle of this radius.
inline constexpr int kFastRadius = 3;

// Appends the FAST-9 corners in `area` (Rosten and Drummond, "Machine learning for high-speed
// corner detection", 2006): nine pixels in a row of the sixteen on the circle are all brighter or
// all darker than the centre by more than `threshold` (1 ... 254). Of neighbouring corners in the
// area only one that is stronger than its eight neighbours stays. The same corners in the same
// order as cv::FAST of the area and its rim, in half the time. `image` is CV_8UC1, and the area
// lies kFastRadius or more from its border.
void AppendFastCorners(const cv::Mat& image,
                       const cv::Rect& area,
                       int threshold,
                       std::vector<Corner>& corners);

}  // namespace semslam

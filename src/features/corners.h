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
  float response = 0;
};

// FAST-9 corners (Rosten and Drummond 2006) that are the strongest among their eight neighbours, at
// least `edge` pixels from the border. Cells of about 30 x 30 px without a corner at
// `initial_threshold` are searched again with `min_threshold`.
std::vector<Corner> DetectCorners(const cv::Mat& image,
                                  int edge,
                                  int initial_threshold,
                                  int min_threshold);

// At most `num_wanted` of the corners, spread evenly over the rectangle that holds them: a quadtree
// is refined until it has that many leaves, and each leaf keeps its strongest corner.
std::vector<Corner> SpreadCorners(std::vector<Corner> corners,
                                  const cv::Rect& region,
                                  int num_wanted);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "features/fast.h"

namespace semslam {

// FAST corners at least `edge` (> kFastRadius) pixels from the border. Cells of about 30 x 30 px
// without a corner at `initial_threshold` are searched again with `min_threshold`.
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

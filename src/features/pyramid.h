// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

namespace semslam {

// Size of the level that is `scale` times coarser than the full image.
cv::Size LevelSize(const cv::Size& full_size, float scale);

// The image `ratio` (1 ... 2) times coarser, by bilinear interpolation: pixel (x, y) of the result
// is taken at (x ratio, y ratio) of the source, so that pixel centres of all levels go through the
// same origin and a position is scaled to another level by one product. (cv::resize shifts by half
// a pixel instead, and scaled positions are then off by up to 1.3 px on the coarsest level.)
cv::Mat Shrink(const cv::Mat& source, const cv::Size& size, double ratio);

// The image blurred by a 7 x 7 Gaussian of sigma 2, borders mirrored, as cv::ORB does before it
// compares pixels (rounding to the nearest from floating point). The image must be >= 4 x 4.
cv::Mat BlurForBrief(const cv::Mat& image);

}  // namespace semslam

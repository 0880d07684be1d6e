// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "features/orb_pattern.h"

namespace semslam {

// Finds out, from the outside, which 256 pairs of pixels cv::ORB compares: random textures are
// described at angle 0, and for each bit every pair of positions that contradicts an observed bit
// is struck out until one is left. The table in src/features/orb_pattern.cc was made by this
// function. Throws std::logic_error if a bit has no pair, or still several, at the end.
std::vector<BriefPair> RecoverOrbPattern();

// The 7 x 7 Gaussian of sigma 2 as it happens inside cv::ORB, which blurs a part of a larger image:
// for such, cv::GaussianBlur works in floating point, and not in the fixed point that it uses for
// an image of its own.
cv::Mat BlurAsOrbDoes(const cv::Mat& image);

}  // namespace semslam

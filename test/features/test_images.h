// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace semslam {

// Blurred noise of several grain sizes over shapes: many corners, at all scales.
cv::Mat MakeTexture(int width, int height, std::uint64_t seed);

// Every `stride`-th colour image of a real clip (grey, CV_8UC1); nothing where the clips are not
// at hand. They are looked for in $SEMSLAM_CLIPS and beside the repository.
std::vector<cv::Mat> LoadClipImages(const std::string& clip, int stride);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

namespace semslam {

// Brightness of a colour image (CV_8UC3, blue first) as ITU-R BT.601 weighs the colours; the very
// values of cv::cvtColor, in the caller's thread alone.
cv::Mat ToGray(const cv::Mat& color);

}  // namespace semslam

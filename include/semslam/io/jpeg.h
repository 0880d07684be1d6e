// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include <opencv2/core/mat.hpp>

namespace semslam {

// The bytes of a JPEG file; `image` is CV_8UC3, not empty, `quality` from 1 to 100.
std::string EncodeJpeg(const cv::Mat& image, int quality = 95);

// CV_8UC3; empty if it is no JPEG file, or a damaged one.
cv::Mat DecodeJpeg(std::string_view jpeg);

}  // namespace semslam

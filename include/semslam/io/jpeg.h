// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <opencv2/core/mat.hpp>

namespace semslam {

// The bytes of a JPEG file; `quality` from 0 to 100. Empty if the image cannot be encoded.
std::string EncodeJpeg(const cv::Mat& image, int quality = 95);

}  // namespace semslam

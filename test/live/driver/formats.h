// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string>
#include <vector>

#include <OniCEnums.h>
#include <opencv2/core/mat.hpp>

namespace semslam::testing {

// By its name in scripts. Throws std::runtime_error if it is none.
OniPixelFormat FormatByName(const std::string& name);

int BytesPerPixel(OniPixelFormat format);

// An image (RGB, or millimetres) as a camera sends it.
cv::Mat Encode(const cv::Mat& image, OniPixelFormat format);

}  // namespace semslam::testing

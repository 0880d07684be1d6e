// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include <opencv2/core/mat.hpp>

#include "semslam/base/time.h"

namespace semslam {

// A colour and a depth image taken together, registered pixel by pixel, as recorded (not
// undistorted).
struct RgbdImage {
  TimeNs time = 0;  // Of the colour image.
  cv::Mat color;    // CV_8UC3, BGR.
  cv::Mat depth;    // CV_32FC1, metres along the optical axis; 0 where there is none.
};

// Images are shared between threads and never changed after they are made.
using RgbdImagePtr = std::shared_ptr<const RgbdImage>;

// 16-bit depth as cameras and PNG files have it (units of 1/depth_factor metres, 0 = none) to
// metres.
cv::Mat DepthToMetres(const cv::Mat& depth_16u, double depth_factor);

}  // namespace semslam

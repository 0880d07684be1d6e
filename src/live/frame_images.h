// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

namespace openni {
class VideoFrameRef;
}

namespace semslam {

// Copies a frame out of OpenNI2's memory. Colour becomes CV_8UC3, BGR; depth CV_32FC1, metres. The
// formats are those that ChooseMode may choose; another, or a frame that is shorter than its
// format says, throws InputError.
cv::Mat ToColor(const openni::VideoFrameRef& frame, bool is_rgb);
cv::Mat ToDepth(const openni::VideoFrameRef& frame);

}  // namespace semslam

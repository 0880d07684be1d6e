// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/camera/rgbd_image.h"

#include "semslam/base/check.h"

namespace semslam {

cv::Mat DepthToMetres(const cv::Mat& depth_16u, double depth_factor) {
  SEMSLAM_CHECK(depth_16u.type() == CV_16UC1) << "type " << depth_16u.type();
  SEMSLAM_CHECK(depth_factor > 0) << "depth_factor = " << depth_factor;
  cv::Mat metres;
  depth_16u.convertTo(metres, CV_32F, 1.0 / depth_factor);
  return metres;
}

}  // namespace semslam

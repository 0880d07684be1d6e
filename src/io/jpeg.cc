// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/jpeg.h"

#include <vector>

#include <opencv2/imgcodecs.hpp>

namespace semslam {

std::string EncodeJpeg(const cv::Mat& image, int quality) {
  std::vector<unsigned char> bytes;
  if (!cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, quality})) return "";
  return {bytes.begin(), bytes.end()};
}

}  // namespace semslam

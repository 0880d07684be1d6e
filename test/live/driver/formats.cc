// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "formats.h"

#include <stdexcept>

#include <opencv2/imgproc.hpp>

namespace semslam::testing {
namespace {

// By ITU-R BT.601: Y from 16 to 235, U and V about 128.
struct Yuv {
  explicit Yuv(const cv::Vec3b& rgb) {
    const double red = rgb[0] / 255.0;
    const double green = rgb[1] / 255.0;
    const double blue = rgb[2] / 255.0;
    const double luma = 0.299 * red + 0.587 * green + 0.114 * blue;
    y = 16 + 219 * luma;
    u = 128 + 224 * 0.5 * (blue - luma) / (1 - 0.114);
    v = 128 + 224 * 0.5 * (red - luma) / (1 - 0.299);
  }
  double y;
  double u;
  double v;
};

// Two pixels side by side share their U and V: U Y V Y, or Y U Y V.
cv::Mat EncodeYuv(const cv::Mat& rgb, bool luma_first) {
  cv::Mat yuv(rgb.size(), CV_8UC2);
  for (int row = 0; row < rgb.rows; ++row) {
    for (int column = 0; column + 1 < rgb.cols; column += 2) {
      const Yuv left(rgb.at<cv::Vec3b>(row, column));
      const Yuv right(rgb.at<cv::Vec3b>(row, column + 1));
      const auto put = [luma_first](cv::Vec2b& pixel, double luma, double chroma) {
        pixel[luma_first ? 0 : 1] = cv::saturate_cast<uchar>(luma);
        pixel[luma_first ? 1 : 0] = cv::saturate_cast<uchar>(chroma);
      };
      put(yuv.at<cv::Vec2b>(row, column), left.y, (left.u + right.u) / 2);
      put(yuv.at<cv::Vec2b>(row, column + 1), right.y, (left.v + right.v) / 2);
    }
  }
  return yuv;
}

}  // namespace

OniPixelFormat FormatByName(const std::string& name) {
  if (name == "RGB888") return ONI_PIXEL_FORMAT_RGB888;
  if (name == "YUV422") return ONI_PIXEL_FORMAT_YUV422;
  if (name == "YUYV") return ONI_PIXEL_FORMAT_YUYV;
  if (name == "GRAY8") return ONI_PIXEL_FORMAT_GRAY8;
  if (name == "JPEG") return ONI_PIXEL_FORMAT_JPEG;
  if (name == "1mm") return ONI_PIXEL_FORMAT_DEPTH_1_MM;
  if (name == "100um") return ONI_PIXEL_FORMAT_DEPTH_100_UM;
  throw std::runtime_error(name + ": no format");
}

int BytesPerPixel(OniPixelFormat format) {
  if (format == ONI_PIXEL_FORMAT_RGB888) return 3;
  return format == ONI_PIXEL_FORMAT_GRAY8 ? 1 : 2;
}

cv::Mat Encode(const cv::Mat& image, OniPixelFormat format) {
  cv::Mat encoded;
  switch (format) {
    case ONI_PIXEL_FORMAT_YUV422:
      return EncodeYuv(image, false);
    case ONI_PIXEL_FORMAT_YUYV:
      return EncodeYuv(image, true);
    case ONI_PIXEL_FORMAT_GRAY8:
      cv::cvtColor(image, encoded, cv::COLOR_RGB2GRAY);
      return encoded;
    case ONI_PIXEL_FORMAT_DEPTH_100_UM:
      image.convertTo(encoded, CV_16U, 10);
      return encoded;
    default:
      return image;
  }
}

}  // namespace semslam::testing

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "live/frame_images.h"

#include <OpenNI.h>
#include <opencv2/imgproc.hpp>

#include "semslam/base/error.h"
#include "semslam/camera/rgbd_image.h"

#include "live/video_modes.h"

namespace semslam {
namespace {

// The frame's own memory as an image, not copied.
cv::Mat View(const openni::VideoFrameRef& frame, int type) {
  const int stride = frame.getStrideInBytes();
  const int row_bytes = frame.getWidth() * static_cast<int>(CV_ELEM_SIZE(type));
  if (stride < row_bytes || frame.getDataSize() < stride * (frame.getHeight() - 1) + row_bytes) {
    throw InputError("an image of " + std::to_string(frame.getDataSize()) +
                     " bytes came, too few for " + Describe(ToMode(frame.getVideoMode())));
  }
  // OpenCV has no view of constant memory; it is only read.
  return {frame.getHeight(), frame.getWidth(), type, const_cast<void*>(frame.getData()),
          static_cast<std::size_t>(stride)};
}

[[noreturn]] void FailFormat(const openni::VideoFrameRef& frame) {
  throw InputError("an image came as " + Describe(ToMode(frame.getVideoMode())) +
                   ", which was not asked for");
}

}  // namespace

cv::Mat ToColor(const openni::VideoFrameRef& frame, bool is_rgb) {
  cv::Mat color;
  switch (frame.getVideoMode().getPixelFormat()) {
    case openni::PIXEL_FORMAT_RGB888: {
      const cv::Mat view = View(frame, CV_8UC3);
      if (!is_rgb) return view.clone();
      cv::cvtColor(view, color, cv::COLOR_RGB2BGR);
      return color;
    }
    case openni::PIXEL_FORMAT_YUV422:
      cv::cvtColor(View(frame, CV_8UC2), color, cv::COLOR_YUV2BGR_UYVY);
      return color;
    case openni::PIXEL_FORMAT_YUYV:
      cv::cvtColor(View(frame, CV_8UC2), color, cv::COLOR_YUV2BGR_YUYV);
      return color;
    case openni::PIXEL_FORMAT_GRAY8:
      cv::cvtColor(View(frame, CV_8UC1), color, cv::COLOR_GRAY2BGR);
      return color;
    default:
      FailFormat(frame);
  }
}

cv::Mat ToDepth(const openni::VideoFrameRef& frame) {
  constexpr double kUnitsPerMetre = 1000;
  switch (frame.getVideoMode().getPixelFormat()) {
    case openni::PIXEL_FORMAT_DEPTH_1_MM:
      return DepthToMetres(View(frame, CV_16UC1), kUnitsPerMetre);
    case openni::PIXEL_FORMAT_DEPTH_100_UM:
      return DepthToMetres(View(frame, CV_16UC1), 10 * kUnitsPerMetre);
    default:
      FailFormat(frame);
  }
}

}  // namespace semslam

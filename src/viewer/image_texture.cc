// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/image_texture.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>
#include <opencv2/imgproc.hpp>

namespace semslam {

void ImageTexture::Set(const cv::Mat& image, int max_width) {
  cv::Mat small = image;
  if (image.cols > max_width) {
    const int height = std::max(1, image.rows * max_width / image.cols);
    cv::resize(image, small, {max_width, height}, 0, 0, cv::INTER_AREA);
  } else if (!image.isContinuous()) {
    small = image.clone();
  }
  glBindTexture(GL_TEXTURE_2D, texture_.id());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, small.cols, small.rows, 0, GL_BGR, GL_UNSIGNED_BYTE,
               small.data);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  width_ = small.cols;
  height_ = small.rows;
}

}  // namespace semslam

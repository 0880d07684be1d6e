// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include "viewer/gl_objects.h"

namespace semslam {

// An image on the graphics card, for a panel.
class ImageTexture {
 public:
  // CV_8UC3, BGR. Larger images are shrunk to this width.
  void Set(const cv::Mat& image, int max_width);
  bool is_empty() const { return width_ == 0; }
  unsigned id() const { return texture_.id(); }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  GlTexture texture_;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace semslam

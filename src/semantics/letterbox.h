// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include <opencv2/core/mat.hpp>

#include "semslam/semantics/detection.h"

namespace semslam {

// Where an image lies inside a network's input.
struct Letterbox {
  int image_width, image_height;    // Pixels of the image,
  int input_width, input_height;    // of the network's input,
  int fitted_width, fitted_height;  // and of the image scaled to fit.
  int left, top;                    // Borders, pixels of the input.

  // Scaled to fit without distortion, and centred. Rounds down where Darknet does.
  static Letterbox Fit(int image_width, int image_height, int input_width, int input_height);
  // Stretched to fill all of it.
  static Letterbox Stretch(int image_width, int image_height, int input_width, int input_height);

  // A box given by centre and size relative to the network's input, in pixels of the image.
  ImageBox ToImage(float centre_x, float centre_y, float width, float height) const;
};

// The images x 3 x height x width blob of 8-bit BGR images of one size: RGB in [0, 1], grey (0.5)
// borders.
cv::Mat MakeBlob(std::span<const cv::Mat> images_bgr, const Letterbox& letterbox);

}  // namespace semslam

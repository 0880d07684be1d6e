// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/letterbox.h"

#include <array>
#include <cstdint>

#include <opencv2/imgproc.hpp>

#include "semslam/base/check.h"

namespace semslam {

Letterbox Letterbox::Fit(int image_width, int image_height, int input_width, int input_height) {
  SEMSLAM_CHECK(image_width > 0 && image_height > 0) << image_width << 'x' << image_height;
  Letterbox fit{image_width, image_height, input_width, input_height,
                input_width, input_height, 0,           0};
  // input_width / image_width < input_height / image_height, without rounding.
  if (std::int64_t{input_width} * image_height < std::int64_t{input_height} * image_width) {
    fit.fitted_height = static_cast<int>(std::int64_t{image_height} * input_width / image_width);
  } else {
    fit.fitted_width = static_cast<int>(std::int64_t{image_width} * input_height / image_height);
  }
  fit.fitted_width = std::max(fit.fitted_width, 1);
  fit.fitted_height = std::max(fit.fitted_height, 1);
  fit.left = (input_width - fit.fitted_width) / 2;
  fit.top = (input_height - fit.fitted_height) / 2;
  return fit;
}

Letterbox Letterbox::Stretch(int image_width, int image_height, int input_width, int input_height) {
  SEMSLAM_CHECK(image_width > 0 && image_height > 0) << image_width << 'x' << image_height;
  return {image_width, image_height, input_width, input_height, input_width, input_height, 0, 0};
}

ImageBox Letterbox::ToImage(float centre_x, float centre_y, float width, float height) const {
  const float scale_x = static_cast<float>(image_width) / static_cast<float>(fitted_width);
  const float scale_y = static_cast<float>(image_height) / static_cast<float>(fitted_height);
  const auto input_w = static_cast<float>(input_width);
  const auto input_h = static_cast<float>(input_height);
  const auto border_x = static_cast<float>(left);
  const auto border_y = static_cast<float>(top);
  return {((centre_x - width / 2) * input_w - border_x) * scale_x,
          ((centre_y - height / 2) * input_h - border_y) * scale_y,
          ((centre_x + width / 2) * input_w - border_x) * scale_x,
          ((centre_y + height / 2) * input_h - border_y) * scale_y};
}

namespace {

void FillImage(const cv::Mat& image_bgr, int number, const Letterbox& letterbox, cv::Mat* blob) {
  SEMSLAM_CHECK(image_bgr.type() == CV_8UC3) << "type " << image_bgr.type();
  cv::Mat fitted;
  cv::resize(image_bgr, fitted, {letterbox.fitted_width, letterbox.fitted_height}, 0, 0,
             cv::INTER_LINEAR);
  for (int channel = 0; channel < 3; ++channel) {
    const int source = 2 - channel;  // BGR to RGB.
    for (int row = 0; row < fitted.rows; ++row) {
      const auto* pixels = fitted.ptr<std::uint8_t>(row);
      const std::array<int, 4> first = {number, channel, letterbox.top + row, letterbox.left};
      float* values = blob->ptr<float>(first.data());
      for (int column = 0; column < fitted.cols; ++column) {
        values[column] = static_cast<float>(pixels[3 * column + source]) / 255.0F;
      }
    }
  }
}

}  // namespace

cv::Mat MakeBlob(std::span<const cv::Mat> images_bgr, const Letterbox& letterbox) {
  const auto num_images = static_cast<int>(images_bgr.size());
  const std::array<int, 4> shape = {num_images, 3, letterbox.input_height, letterbox.input_width};
  cv::Mat blob(4, shape.data(), CV_32F, cv::Scalar(0.5));
  for (int i = 0; i < num_images; ++i) {
    FillImage(images_bgr[static_cast<std::size_t>(i)], i, letterbox, &blob);
  }
  return blob;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/texture.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "semslam/base/check.h"

namespace semslam {
namespace {

int Wrap(int index, int size) {
  const int rest = index % size;
  return rest < 0 ? rest + size : rest;
}

Eigen::Vector3f ToVector(const cv::Vec4b& texel) {
  return {static_cast<float>(texel[0]), static_cast<float>(texel[1]), static_cast<float>(texel[2])};
}

Eigen::Vector3f Bilinear(const cv::Mat& level, const Eigen::Vector2f& uv) {
  const float x = (uv.x() - std::floor(uv.x())) * static_cast<float>(level.cols) - 0.5F;
  const float y = (std::ceil(uv.y()) - uv.y()) * static_cast<float>(level.rows) - 0.5F;
  const float x_floor = std::floor(x);
  const float y_floor = std::floor(y);
  const int x0 = Wrap(static_cast<int>(x_floor), level.cols);
  const int x1 = x0 + 1 == level.cols ? 0 : x0 + 1;
  const int y0 = Wrap(static_cast<int>(y_floor), level.rows);
  const int y1 = y0 + 1 == level.rows ? 0 : y0 + 1;
  const auto* row0 = level.ptr<cv::Vec4b>(y0);
  const auto* row1 = level.ptr<cv::Vec4b>(y1);
  const float wx = x - x_floor;
  const float wy = y - y_floor;
  const Eigen::Vector3f top = ToVector(row0[x0]) * (1 - wx) + ToVector(row0[x1]) * wx;
  const Eigen::Vector3f bottom = ToVector(row1[x0]) * (1 - wx) + ToVector(row1[x1]) * wx;
  return top * (1 - wy) + bottom * wy;
}

}  // namespace

Texture::Texture(const cv::Mat& image) {
  SEMSLAM_CHECK(image.type() == CV_8UC3 && !image.empty());
  cv::Mat level;
  cv::cvtColor(image, level, cv::COLOR_BGR2BGRA);
  while (true) {
    levels_.push_back(level);
    if (level.cols == 1 && level.rows == 1) break;
    cv::Mat half;
    const cv::Size size(std::max(1, level.cols / 2), std::max(1, level.rows / 2));
    cv::resize(level, half, size, 0, 0, cv::INTER_AREA);
    level = half;
  }
}

Eigen::Vector3f Texture::Sample(const Eigen::Vector2f& uv, float footprint) const {
  const float texels = std::max(1.0F, footprint * static_cast<float>(levels_.front().cols));
  const float level = std::min(std::log2(texels), static_cast<float>(levels_.size() - 1));
  const auto fine = static_cast<std::size_t>(level);
  const float weight = level - static_cast<float>(fine);
  Eigen::Vector3f color = Bilinear(levels_[fine], uv);
  if (weight > 0.02F && fine + 1 < levels_.size()) {
    color += weight * (Bilinear(levels_[fine + 1], uv) - color);
  }
  return color * (1.0F / 255.0F);
}

}  // namespace semslam

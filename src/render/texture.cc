// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/texture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <emmintrin.h>
#include <opencv2/imgproc.hpp>

#include "semslam/base/check.h"

namespace semslam {
namespace {

// For an index at most one step outside.
int Wrap(int index, int size) {
  if (index < 0) return size - 1;
  return index < size ? index : 0;
}

// The four bytes of a texel as floats.
__m128 ToFloats(const cv::Vec4b& texel) {
  std::int32_t packed = 0;
  std::memcpy(&packed, texel.val, sizeof(packed));
  const __m128i zero = _mm_setzero_si128();
  const __m128i words = _mm_unpacklo_epi8(_mm_cvtsi32_si128(packed), zero);
  return _mm_cvtepi32_ps(_mm_unpacklo_epi16(words, zero));
}

// a + weight * (b - a).
__m128 Mix(__m128 a, __m128 b, __m128 weight) {
  return _mm_add_ps(a, _mm_mul_ps(weight, _mm_sub_ps(b, a)));
}

// Largest whole number below; SSE2 has no instruction for it.
float FastFloor(float value) {
  const auto whole = static_cast<float>(static_cast<int>(value));
  return whole > value ? whole - 1.0F : whole;
}

// Values 0 to 255, in the first three places.
__m128 Bilinear(const cv::Mat& level, const Eigen::Vector2f& unit) {
  const float x = unit.x() * static_cast<float>(level.cols) - 0.5F;
  const float y = unit.y() * static_cast<float>(level.rows) - 0.5F;
  const float x_floor = FastFloor(x);
  const float y_floor = FastFloor(y);
  const int x0 = Wrap(static_cast<int>(x_floor), level.cols);
  const int x1 = x0 + 1 == level.cols ? 0 : x0 + 1;
  const int y0 = Wrap(static_cast<int>(y_floor), level.rows);
  const int y1 = y0 + 1 == level.rows ? 0 : y0 + 1;
  const auto* row0 = level.ptr<cv::Vec4b>(y0);
  const auto* row1 = level.ptr<cv::Vec4b>(y1);
  const __m128 wx = _mm_set1_ps(x - x_floor);
  const __m128 top = Mix(ToFloats(row0[x0]), ToFloats(row0[x1]), wx);
  const __m128 bottom = Mix(ToFloats(row1[x0]), ToFloats(row1[x1]), wx);
  return Mix(top, bottom, _mm_set1_ps(y - y_floor));
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
  const Eigen::Vector2f unit(uv.x() - FastFloor(uv.x()), 1.0F - (uv.y() - FastFloor(uv.y())));
  __m128 color = Bilinear(levels_[fine], unit);
  if (weight > 0.02F && fine + 1 < levels_.size()) {
    color = Mix(color, Bilinear(levels_[fine + 1], unit), _mm_set1_ps(weight));
  }
  alignas(16) float channels[4];
  _mm_store_ps(channels, _mm_mul_ps(color, _mm_set1_ps(1.0F / 255.0F)));
  return {channels[0], channels[1], channels[2]};
}

}  // namespace semslam

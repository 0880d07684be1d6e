// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/texture.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <utility>

#include <emmintrin.h>
#include <opencv2/imgproc.hpp>

#include "semslam/base/check.h"

namespace semslam {
namespace {

constexpr int kFractionBits = 7;  // Of places between texels: all of the sum fits 16 bits.
constexpr int kOne = 1 << kFractionBits;

// Largest whole number below; SSE2 has no instruction for it.
float FastFloor(float value) {
  const auto whole = static_cast<float>(static_cast<int>(value));
  return whole > value ? whole - 1.0F : whole;
}

// Logarithm to base 2 of a number >= 1, with an error below 0.01: a parabola between powers of two.
float ApproximateLog2(float value) {
  constexpr int kMantissaBits = 23;
  constexpr int kBias = 127;
  const float linear =
      static_cast<float>(std::bit_cast<std::int32_t>(value) - (kBias << kMantissaBits)) *
      (1.0F / (1 << kMantissaBits));
  const float part = linear - static_cast<float>(static_cast<int>(linear));
  return linear + 0.34F * part * (1.0F - part);
}

// Between two texels: the first one's index, and the weight of the second in parts of kOne.
struct Between {
  int index;
  int weight;
};

Between PlaceOf(float unit, int size) {
  // One texel more, so that nothing is negative.
  const auto fixed =
      static_cast<int>((unit * static_cast<float>(size) + 0.5F) * static_cast<float>(kOne));
  const int index = (fixed >> kFractionBits) - 1;
  return {index < 0 ? size - 1 : index, fixed & (kOne - 1)};
}

// Two texels side by side as eight numbers.
__m128i LoadPair(const std::uint32_t* texels) {
  return _mm_unpacklo_epi8(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(texels)),
                           _mm_setzero_si128());
}

}  // namespace

// Bilinear. Values 0 to 255 times kOne^2, in the first three places.
__m128 Texture::Level::At(const Eigen::Vector2f& unit) const {
  const Between x = PlaceOf(unit.x(), num_columns);
  const Between y = PlaceOf(unit.y(), num_rows);
  const std::size_t stride = static_cast<std::size_t>(num_columns) + 1;
  const std::uint32_t* upper = texels.data() + y.index * stride + x.index;
  const auto word = [](int value) { return static_cast<short>(value); };
  const __m128i pair =
      _mm_add_epi16(_mm_mullo_epi16(LoadPair(upper), _mm_set1_epi16(word(kOne - y.weight))),
                    _mm_mullo_epi16(LoadPair(upper + stride), _mm_set1_epi16(word(y.weight))));
  const __m128i channels = _mm_unpacklo_epi16(pair, _mm_unpackhi_epi64(pair, pair));
  const __m128i weights = _mm_set1_epi32(x.weight << 16 | (kOne - x.weight));
  return _mm_cvtepi32_ps(_mm_madd_epi16(channels, weights));
}

Texture::Texture(const cv::Mat& image) {
  SEMSLAM_CHECK(image.type() == CV_8UC3 && !image.empty());
  cv::Mat picture;
  cv::cvtColor(image, picture, cv::COLOR_BGR2BGRA);
  while (true) {
    cv::Mat bordered;
    cv::copyMakeBorder(picture, bordered, 0, 1, 0, 1, cv::BORDER_WRAP);
    Level level = {picture.cols, picture.rows, std::vector<std::uint32_t>(bordered.total())};
    std::memcpy(level.texels.data(), bordered.data, bordered.total() * sizeof(std::uint32_t));
    levels_.push_back(std::move(level));
    if (picture.cols == 1 && picture.rows == 1) break;
    cv::Mat half;
    const cv::Size size(std::max(1, picture.cols / 2), std::max(1, picture.rows / 2));
    cv::resize(picture, half, size, 0, 0, cv::INTER_AREA);
    picture = half;
  }
}

Eigen::Vector3f Texture::Sample(const Eigen::Vector2f& uv, float footprint) const {
  const float texels = std::max(1.0F, footprint * static_cast<float>(levels_.front().num_columns));
  const float place = std::min(ApproximateLog2(texels), static_cast<float>(levels_.size() - 1));
  const auto fine = static_cast<std::size_t>(place);
  // Near a level that one alone is taken: the other would hardly show, and costs as much.
  constexpr float kAlone = 0.02F;
  const float weight =
      (place - static_cast<float>(fine) - kAlone) * (1.0F / (1.0F - 2.0F * kAlone));
  const Eigen::Vector2f unit(uv.x() - FastFloor(uv.x()), 1.0F - (uv.y() - FastFloor(uv.y())));
  const std::size_t coarse = std::min(fine + 1, levels_.size() - 1);
  __m128 color = levels_[weight < 1.0F ? fine : coarse].At(unit);
  if (weight > 0.0F && weight < 1.0F) {
    const __m128 other = levels_[coarse].At(unit);
    color = _mm_add_ps(color, _mm_mul_ps(_mm_set1_ps(weight), _mm_sub_ps(other, color)));
  }
  alignas(16) float channels[4];
  _mm_store_ps(channels, _mm_mul_ps(color, _mm_set1_ps(1.0F / (255.0F * kOne * kOne))));
  return {channels[0], channels[1], channels[2]};
}

}  // namespace semslam

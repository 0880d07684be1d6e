// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/texture.h"

#include <algorithm>
#include <array>
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

// Largest whole numbers below; SSE2 has no instruction for it.
__m128 Floor(__m128 values) {
  const __m128 whole = _mm_cvtepi32_ps(_mm_cvttps_epi32(values));
  return _mm_sub_ps(whole, _mm_and_ps(_mm_cmpgt_ps(whole, values), _mm_set1_ps(1.0F)));
}

// Logarithms to base 2 of numbers >= 1, with an error below 0.01: parabolas between powers of two.
__m128 ApproximateLog2(__m128 values) {
  constexpr int kMantissaBits = 23;
  constexpr int kBias = 127;
  const __m128i bits =
      _mm_sub_epi32(_mm_castps_si128(values), _mm_set1_epi32(kBias << kMantissaBits));
  const __m128 linear = _mm_mul_ps(_mm_cvtepi32_ps(bits), _mm_set1_ps(1.0F / (1 << kMantissaBits)));
  const __m128 part = _mm_sub_ps(linear, _mm_cvtepi32_ps(_mm_cvttps_epi32(linear)));
  const __m128 bend =
      _mm_mul_ps(_mm_mul_ps(_mm_set1_ps(0.34F), part), _mm_sub_ps(_mm_set1_ps(1.0F), part));
  return _mm_add_ps(linear, bend);
}

using FourInts = std::array<std::int32_t, 4>;

FourInts Stored(__m128i values) {
  FourInts result;
  _mm_storeu_si128(reinterpret_cast<__m128i*>(result.data()), values);
  return result;
}

// Between two texels: the first one's index, and the weight of the second in parts of kOne.
struct Between {
  FourInts index;
  FourInts weight;
};

Between PlacesOf(__m128 units, __m128 sizes) {
  // One texel more, so that nothing is negative.
  const __m128 texels = _mm_add_ps(_mm_mul_ps(units, sizes), _mm_set1_ps(0.5F));
  const __m128i fixed = _mm_cvttps_epi32(_mm_mul_ps(texels, _mm_set1_ps(kOne)));
  const __m128i index = _mm_sub_epi32(_mm_srai_epi32(fixed, kFractionBits), _mm_set1_epi32(1));
  const __m128i before = _mm_srai_epi32(index, 31);  // -1: the last texel is before the first.
  const __m128i wrapped = _mm_add_epi32(index, _mm_and_si128(before, _mm_cvttps_epi32(sizes)));
  return {Stored(wrapped), Stored(_mm_and_si128(fixed, _mm_set1_epi32(kOne - 1)))};
}

// Two texels side by side as eight numbers.
__m128i LoadPair(const std::uint32_t* texels) {
  return _mm_unpacklo_epi8(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(texels)),
                           _mm_setzero_si128());
}

// Bilinear. Values 0 to 255 times kOne^2, in the first three places.
__m128 Blend(const std::uint32_t* upper, std::size_t stride, int weight_x, int weight_y) {
  const auto word = [](int value) { return static_cast<short>(value); };
  const __m128i pair =
      _mm_add_epi16(_mm_mullo_epi16(LoadPair(upper), _mm_set1_epi16(word(kOne - weight_y))),
                    _mm_mullo_epi16(LoadPair(upper + stride), _mm_set1_epi16(word(weight_y))));
  const __m128i channels = _mm_unpacklo_epi16(pair, _mm_unpackhi_epi64(pair, pair));
  const __m128i weights = _mm_set1_epi32(weight_x << 16 | (kOne - weight_x));
  return _mm_cvtepi32_ps(_mm_madd_epi16(channels, weights));
}

}  // namespace

// Each place of the level that its index says.
Texture::FourColors Texture::SampleLevels(__m128i indices, __m128 unit_x, __m128 unit_y) const {
  const FourInts index = Stored(indices);
  const std::array<const Level*, 4> levels = {&levels_[index[0]], &levels_[index[1]],
                                              &levels_[index[2]], &levels_[index[3]]};
  const Between x = PlacesOf(unit_x, _mm_setr_ps(levels[0]->num_columns, levels[1]->num_columns,
                                                 levels[2]->num_columns, levels[3]->num_columns));
  const Between y = PlacesOf(unit_y, _mm_setr_ps(levels[0]->num_rows, levels[1]->num_rows,
                                                 levels[2]->num_rows, levels[3]->num_rows));
  FourColors colors;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t stride = static_cast<std::size_t>(levels[i]->num_columns) + 1;
    const std::uint32_t* upper = levels[i]->texels.data() + y.index[i] * stride + x.index[i];
    colors.at[i] = Blend(upper, stride, x.weight[i], y.weight[i]);
  }
  return colors;
}

Texture::Texture(const cv::Mat& image) {
  SEMSLAM_CHECK(image.type() == CV_8UC3 && !image.empty());
  cv::Mat picture;
  cv::cvtColor(image, picture, cv::COLOR_BGR2BGRA);
  while (true) {
    cv::Mat bordered;
    cv::copyMakeBorder(picture, bordered, 0, 1, 0, 1, cv::BORDER_WRAP);
    Level level = {static_cast<float>(picture.cols), static_cast<float>(picture.rows),
                   std::vector<std::uint32_t>(bordered.total())};
    std::memcpy(level.texels.data(), bordered.data, bordered.total() * sizeof(std::uint32_t));
    levels_.push_back(std::move(level));
    if (picture.cols == 1 && picture.rows == 1) break;
    cv::Mat half;
    const cv::Size size(std::max(1, picture.cols / 2), std::max(1, picture.rows / 2));
    cv::resize(picture, half, size, 0, 0, cv::INTER_AREA);
    picture = half;
  }
}

Texture::Colors Texture::Sample(const Places& places) const {
  const __m128 one = _mm_set1_ps(1.0F);
  const __m128 texels =
      _mm_max_ps(one, _mm_mul_ps(places.footprint, _mm_set1_ps(levels_.front().num_columns)));
  const auto last = static_cast<int>(levels_.size()) - 1;
  const __m128 place = _mm_min_ps(ApproximateLog2(texels), _mm_set1_ps(static_cast<float>(last)));
  const __m128i fine = _mm_cvttps_epi32(place);
  // -1 added where there is a level more.
  const __m128i coarse = _mm_sub_epi32(fine, _mm_cmplt_epi32(fine, _mm_set1_epi32(last)));
  // Near a level that one alone is taken: the other would hardly show.
  constexpr float kAlone = 0.02F;
  const __m128 weight =
      _mm_mul_ps(_mm_sub_ps(_mm_sub_ps(place, _mm_cvtepi32_ps(fine)), _mm_set1_ps(kAlone)),
                 _mm_set1_ps(1.0F / (1.0F - 2.0F * kAlone)));
  const __m128 unit_x = _mm_sub_ps(places.u, Floor(places.u));
  const __m128 unit_y = _mm_sub_ps(one, _mm_sub_ps(places.v, Floor(places.v)));
  FourColors colors = SampleLevels(fine, unit_x, unit_y);
  const FourColors others = SampleLevels(coarse, unit_x, unit_y);
  alignas(16) std::array<float, 4> weights;
  _mm_store_ps(weights.data(), _mm_min_ps(_mm_max_ps(weight, _mm_setzero_ps()), one));
  for (std::size_t i = 0; i < 4; ++i) {
    const __m128 step = _mm_mul_ps(_mm_set1_ps(weights[i]), _mm_sub_ps(others.at[i], colors.at[i]));
    colors.at[i] =
        _mm_mul_ps(_mm_add_ps(colors.at[i], step), _mm_set1_ps(1.0F / (255.0F * kOne * kOne)));
  }
  _MM_TRANSPOSE4_PS(colors.at[0], colors.at[1], colors.at[2], colors.at[3]);
  return {colors.at[0], colors.at[1], colors.at[2]};
}

Eigen::Vector3f Texture::Sample(const Eigen::Vector2f& uv, float footprint) const {
  const Colors colors = Sample({_mm_set1_ps(uv.x()), _mm_set1_ps(uv.y()), _mm_set1_ps(footprint)});
  return {_mm_cvtss_f32(colors.blue), _mm_cvtss_f32(colors.green), _mm_cvtss_f32(colors.red)};
}

}  // namespace semslam

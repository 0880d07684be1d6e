// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/pyramid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "semslam/base/check.h"
#include "semslam/base/simd_clones.h"

#include "features/row_shrinker.h"

namespace semslam {
cv::Size LevelSize(const cv::Size& full_size, float scale) {
  return {static_cast<int>(std::lround(static_cast<float>(full_size.width) / scale)),
          static_cast<int>(std::lround(static_cast<float>(full_size.height) / scale))};
}

namespace {

// Rows are worked on up to a multiple of this, so that vector instructions do all of it, and images
// have room for that.
constexpr int kBlock = 32;
int PaddedWidth(int width) { return (width + kBlock - 1) / kBlock * kBlock; }
cv::Mat MakePaddedImage(const cv::Size& size) {
  return cv::Mat(size.height, PaddedWidth(size.width), CV_8UC1).colRange(0, size.width);
}

// Two rows of values kRowOne times too large to one of grey values. The sums have 23 bits: the
// upper 15 of the two products, and what the lower 8 carry, are all that matters for the rounded
// result, and fit 16 bits.
SEMSLAM_SIMD_CLONES void MixRows(const std::uint16_t* __restrict upper,
                                 const std::uint16_t* __restrict lower,
                                 const Tap& tap,
                                 int width,
                                 std::uint8_t* __restrict out) {
  static_assert(kRowOne == 256 && kTapOne == 128);
  const auto upper_weight = static_cast<std::uint16_t>(256 * tap.weight);
  const auto lower_weight = static_cast<std::uint16_t>(256 * tap.weight_next);
  const auto high = [](std::uint16_t value, std::uint16_t weight) {
    return static_cast<std::uint16_t>(std::uint32_t{value} * weight >> 16);
  };
  const auto low = [](std::uint16_t value, std::uint16_t weight) {
    return static_cast<std::uint16_t>(static_cast<std::uint16_t>(value * weight) >> 8);
  };
  for (int x = 0; x < width; ++x) {
    const auto carry = static_cast<std::uint16_t>(
        (low(upper[x], upper_weight) + low(lower[x], lower_weight)) >> 8);
    const auto sum = static_cast<std::uint16_t>(high(upper[x], upper_weight) +
                                                high(lower[x], lower_weight) + carry);
    out[x] = static_cast<std::uint8_t>((sum + kTapOne / 2) >> kTapBits);
  }
}

}  // namespace

cv::Mat Shrink(const cv::Mat& source, const cv::Size& size, double ratio) {
  SEMSLAM_CHECK(source.type() == CV_8UC1 && source.cols >= 2 && source.rows >= 2)
      << source.cols << "x" << source.rows << ", type " << source.type();
  const int width = PaddedWidth(size.width);
  const RowShrinker shrinker(width, source.cols, ratio);
  const std::vector<Tap> rows = MakeTaps(size.height, source.rows, ratio);
  cv::Mat result = MakePaddedImage(size);
  std::vector<std::uint16_t> upper(width);
  std::vector<std::uint16_t> lower(width);
  int lower_row = -1;  // Of the source.
  for (int y = 0; y < size.height; ++y) {
    const Tap& tap = rows[y];
    if (tap.index == lower_row) {
      std::swap(upper, lower);
    } else if (tap.index != lower_row - 1) {
      shrinker.Shrink(source.ptr<std::uint8_t>(tap.index), upper.data());
    }
    if (tap.index + 1 != lower_row) {
      lower_row = tap.index + 1;
      shrinker.Shrink(source.ptr<std::uint8_t>(lower_row), lower.data());
    }
    MixRows(upper.data(), lower.data(), tap, width, result.ptr<std::uint8_t>(y));
  }
  return result;
}

namespace {

constexpr int kBlurRadius = 3;

// exp(-i^2 / (2 sigma^2)) for i = 0 ... 3, sigma = 2, normalised to a sum of 1.
std::array<float, kBlurRadius + 1> BlurWeights() {
  std::array<double, kBlurRadius + 1> weights{};
  double sum = 0;
  for (int i = 0; i <= kBlurRadius; ++i) {
    weights[i] = std::exp(-i * i / 8.0);
    sum += i == 0 ? weights[i] : 2 * weights[i];
  }
  std::array<float, kBlurRadius + 1> normalised{};
  for (int i = 0; i <= kBlurRadius; ++i) normalised[i] = static_cast<float>(weights[i] / sum);
  return normalised;
}

// ... 2 1 | 0 1 2 ... size-1 | size-2 ...
int Mirror(int i, int size) { return i < 0 ? -i : i >= size ? 2 * size - 2 - i : i; }

// One row blurred along x, and what is after it up to the padded width; `padded` is scratch of that
// width + 2 radius.
SEMSLAM_SIMD_CLONES void BlurRow(const std::uint8_t* row,
                                 int width,
                                 int padded_width,
                                 const std::array<float, kBlurRadius + 1>& k,
                                 std::vector<float>& padded,
                                 float* __restrict out) {
  float* middle = padded.data() + kBlurRadius;
  for (int x = 0; x < width; ++x) middle[x] = row[x];
  for (int i = 1; i <= kBlurRadius; ++i) {
    middle[-i] = middle[i];
    middle[width - 1 + i] = middle[width - 1 - i];
  }
  for (int x = 0; x < padded_width; ++x) {
    const float* p = middle + x;
    out[x] = k[0] * p[0] + k[1] * (p[-1] + p[1]) + k[2] * (p[-2] + p[2]) + k[3] * (p[-3] + p[3]);
  }
}

// Rows blurred along x to one row blurred along y too. Adding 1.5 * 2^23 rounds to the nearest
// integer, ties to even, and leaves it in the low bits.
SEMSLAM_SIMD_CLONES void BlurColumns(const std::array<const float*, 2 * kBlurRadius + 1>& r,
                                     int width,
                                     const std::array<float, kBlurRadius + 1>& k,
                                     std::uint8_t* __restrict out) {
  for (int x = 0; x < width; ++x) {
    const float sum = k[0] * r[3][x] + k[1] * (r[2][x] + r[4][x]) + k[2] * (r[1][x] + r[5][x]) +
                      k[3] * (r[0][x] + r[6][x]);
    out[x] = static_cast<std::uint8_t>(std::bit_cast<std::uint32_t>(sum + 12582912.0F));
  }
}

}  // namespace

cv::Mat BlurForBrief(const cv::Mat& image) {
  SEMSLAM_CHECK(image.type() == CV_8UC1 && image.cols > kBlurRadius && image.rows > kBlurRadius)
      << image.cols << "x" << image.rows << ", type " << image.type();
  constexpr int kNumRows = 2 * kBlurRadius + 1;
  const std::array<float, kBlurRadius + 1> weights = BlurWeights();
  const int width = PaddedWidth(image.cols);
  std::vector<float> padded(width + 2 * kBlurRadius);
  std::vector<float> ring(static_cast<std::size_t>(kNumRows) * width);  // Row y at y % 7.
  const auto ring_row = [&](int y) { return ring.data() + (y % kNumRows) * width; };

  cv::Mat result = MakePaddedImage(image.size());
  int num_blurred = 0;
  for (int y = 0; y < image.rows; ++y) {
    for (; num_blurred < std::min(y + kBlurRadius + 1, image.rows); ++num_blurred) {
      BlurRow(image.ptr<std::uint8_t>(num_blurred), image.cols, width, weights, padded,
              ring_row(num_blurred));
    }
    std::array<const float*, kNumRows> rows{};
    for (int i = 0; i < kNumRows; ++i) {
      rows[i] = ring_row(Mirror(y + i - kBlurRadius, image.rows));
    }
    BlurColumns(rows, width, weights, result.ptr<std::uint8_t>(y));
  }
  return result;
}

}  // namespace semslam

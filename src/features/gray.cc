// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/gray.h"

#include <cstdint>

#include "semslam/base/check.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace semslam {
namespace {

// Weights of the colours; they sum to 2^15.
constexpr int kBits = 15;
constexpr int kBlue = 3735;
constexpr int kGreen = 19235;
constexpr int kRed = 9798;
constexpr int kHalf = 1 << (kBits - 1);
static_assert(kBlue + kGreen + kRed == 1 << kBits);

#if defined(__x86_64__)
bool HasVectors() { return __builtin_cpu_supports("avx2") != 0; }

// Eight pixels of a row, as 32-bit numbers: four from the first twelve bytes, four from the next.
__attribute__((target("avx2"), always_inline)) inline __m256i GrayOfEight(const std::uint8_t* bgr) {
  // Of each pixel blue and green as 16-bit numbers, then red; -1: a zero. The upper half's bytes
  // begin four before its first pixel.
  const __m256i blue_green =
      _mm256_setr_epi8(0, -1, 1, -1, 3, -1, 4, -1, 6, -1, 7, -1, 9, -1, 10, -1, 4, -1, 5, -1, 7, -1,
                       8, -1, 10, -1, 11, -1, 13, -1, 14, -1);
  const __m256i red =
      _mm256_setr_epi8(2, -1, -1, -1, 5, -1, -1, -1, 8, -1, -1, -1, 11, -1, -1, -1, 6, -1, -1, -1,
                       9, -1, -1, -1, 12, -1, -1, -1, 15, -1, -1, -1);
  const __m256i bytes = _mm256_loadu2_m128i(reinterpret_cast<const __m128i*>(bgr + 8),
                                            reinterpret_cast<const __m128i*>(bgr));
  const __m256i two = _mm256_madd_epi16(_mm256_shuffle_epi8(bytes, blue_green),
                                        _mm256_set1_epi32(kBlue + (kGreen << 16)));
  const __m256i third = _mm256_madd_epi16(_mm256_shuffle_epi8(bytes, red), _mm256_set1_epi32(kRed));
  const __m256i sum = _mm256_add_epi32(_mm256_add_epi32(two, third), _mm256_set1_epi32(kHalf));
  return _mm256_srli_epi32(sum, kBits);
}

// Returns how many pixels it did.
__attribute__((target("avx2"))) int RowToGrayInBlocks(const std::uint8_t* bgr,
                                                      int width,
                                                      std::uint8_t* gray) {
  constexpr int kBlock = 32;
  const __m256i fours_in_order = _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7);
  int x = 0;
  for (; x + kBlock <= width; x += kBlock) {
    const std::uint8_t* first = bgr + 3 * x;
    const __m256i lower = _mm256_packs_epi32(GrayOfEight(first), GrayOfEight(first + 24));
    const __m256i upper = _mm256_packs_epi32(GrayOfEight(first + 48), GrayOfEight(first + 72));
    const __m256i pixels =
        _mm256_permutevar8x32_epi32(_mm256_packus_epi16(lower, upper), fours_in_order);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(gray + x), pixels);
  }
  return x;
}
#else
bool HasVectors() { return false; }
int RowToGrayInBlocks(const std::uint8_t*, int, std::uint8_t*) { return 0; }
#endif

}  // namespace

cv::Mat ToGray(const cv::Mat& color) {
  SEMSLAM_CHECK(color.type() == CV_8UC3) << "type " << color.type();
  cv::Mat result(color.size(), CV_8UC1);
  for (int y = 0; y < color.rows; ++y) {
    const auto* bgr = color.ptr<std::uint8_t>(y);
    auto* gray = result.ptr<std::uint8_t>(y);
    for (int x = HasVectors() ? RowToGrayInBlocks(bgr, color.cols, gray) : 0; x < color.cols; ++x) {
      const int sum = kBlue * bgr[3 * x] + kGreen * bgr[3 * x + 1] + kRed * bgr[3 * x + 2];
      gray[x] = static_cast<std::uint8_t>((sum + kHalf) >> kBits);
    }
  }
  return result;
}

}  // namespace semslam

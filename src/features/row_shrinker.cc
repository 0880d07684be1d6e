// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/row_shrinker.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace semslam {
namespace {

constexpr int kGroupSize = 8;
constexpr int kGroupReach = 16;

#if defined(__x86_64__)
bool HasGroups() { return __builtin_cpu_supports("ssse3") != 0; }
bool HasPairsOfGroups() { return __builtin_cpu_supports("avx2") != 0; }
#else
bool HasGroups() { return false; }
bool HasPairsOfGroups() { return false; }
#endif

}  // namespace

std::vector<Tap> MakeTaps(int size, int source_size, double ratio) {
  std::vector<Tap> taps(size);
  for (int i = 0; i < size; ++i) {
    const double position = std::min(i * ratio, source_size - 1.0);
    const int index = std::clamp(static_cast<int>(position), 0, std::max(source_size - 2, 0));
    const auto next = static_cast<std::int16_t>(std::lround((position - index) * kTapOne));
    taps[i] = {index, static_cast<std::int16_t>(kTapOne - next), next};
  }
  return taps;
}

RowShrinker::RowShrinker(int width, int source_width, double ratio)
    : taps_(MakeTaps(width, source_width, ratio)) {
  if (!HasGroups() || source_width < kGroupReach) return;
  for (int begin = 0; begin + kGroupSize <= width; begin += kGroupSize) {
    const std::int32_t first = std::min(taps_[begin].index, source_width - kGroupReach);
    Bytes neighbours{};
    Bytes weights{};
    for (int i = 0; i < kGroupSize; ++i) {
      const Tap& tap = taps_[begin + i];
      const int offset = tap.index - first;
      if (offset + 1 >= kGroupReach) return;
      neighbours[2 * i] = static_cast<std::uint8_t>(offset);
      neighbours[2 * i + 1] = static_cast<std::uint8_t>(offset + 1);
      weights[2 * i] = static_cast<std::uint8_t>(tap.weight);
      weights[2 * i + 1] = static_cast<std::uint8_t>(tap.weight_next);
    }
    first_pixels_.push_back(first);
    neighbours_.push_back(neighbours);
    weights_.push_back(weights);
  }
}

void RowShrinker::Shrink(const std::uint8_t* row, std::uint16_t* out) const {
  ShrinkGroups(HasPairsOfGroups() ? ShrinkPairsOfGroups(row, out) : 0, row, out);
  for (std::size_t x = first_pixels_.size() * kGroupSize; x < taps_.size(); ++x) {
    const Tap& tap = taps_[x];
    const int sum = row[tap.index] * tap.weight + row[tap.index + 1] * tap.weight_next;
    out[x] = static_cast<std::uint16_t>(kRowOne / kTapOne * sum);
  }
}

#if defined(__x86_64__)
// The product of unsigned and signed bytes takes the pixels as signed ones, 128 lower. The two
// weights sum to kTapOne, so that this lowers each result by the same amount, which is added again.
__attribute__((target("ssse3"))) void RowShrinker::ShrinkGroups(int begin,
                                                                const std::uint8_t* row,
                                                                std::uint16_t* out) const {
  const __m128i signs = _mm_set1_epi8(-128);
  const __m128i lowered_by = _mm_set1_epi16(static_cast<std::int16_t>(128 * kRowOne));
  const auto load = [](const std::uint8_t* bytes) __attribute__((target("ssse3"))) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes));
  };
  for (int g = begin; g < num_groups(); ++g) {
    const __m128i pixels =
        _mm_shuffle_epi8(load(row + first_pixels_[g]), load(neighbours_[g].data()));
    const __m128i sums = _mm_maddubs_epi16(load(weights_[g].data()), _mm_xor_si128(pixels, signs));
    const __m128i values = _mm_add_epi16(_mm_add_epi16(sums, sums), lowered_by);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out + g * kGroupSize), values);
  }
}

// The same, two groups at once. Returns how many it did.
__attribute__((target("avx2"))) int RowShrinker::ShrinkPairsOfGroups(const std::uint8_t* row,
                                                                     std::uint16_t* out) const {
  const __m256i signs = _mm256_set1_epi8(-128);
  const __m256i lowered_by = _mm256_set1_epi16(static_cast<std::int16_t>(128 * kRowOne));
  const auto* neighbours = reinterpret_cast<const __m256i*>(neighbours_.data());
  const auto* weights = reinterpret_cast<const __m256i*>(weights_.data());
  const int num_paired = num_groups() / 2 * 2;
  for (int g = 0; g < num_paired; g += 2) {
    const __m256i both =
        _mm256_loadu2_m128i(reinterpret_cast<const __m128i*>(row + first_pixels_[g + 1]),
                            reinterpret_cast<const __m128i*>(row + first_pixels_[g]));
    const __m256i pixels = _mm256_shuffle_epi8(both, _mm256_loadu_si256(neighbours + g / 2));
    const __m256i sums =
        _mm256_maddubs_epi16(_mm256_loadu_si256(weights + g / 2), _mm256_xor_si256(pixels, signs));
    const __m256i values = _mm256_add_epi16(_mm256_add_epi16(sums, sums), lowered_by);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + g * kGroupSize), values);
  }
  return num_paired;
}
#else
int RowShrinker::ShrinkPairsOfGroups(const std::uint8_t*, std::uint16_t*) const { return 0; }
void RowShrinker::ShrinkGroups(int, const std::uint8_t*, std::uint16_t*) const {}
#endif

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/row_shrinker.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#if defined(__x86_64__)
#include <tmmintrin.h>
#endif

namespace semslam {
namespace {

constexpr int kGroupSize = 8;
constexpr int kGroupReach = 16;

#if defined(__x86_64__)
bool HasGroups() { return __builtin_cpu_supports("ssse3") != 0; }
#else
bool HasGroups() { return false; }
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
  if (!HasGroups()) return;
  for (int begin = 0; begin + kGroupSize <= width; begin += kGroupSize) {
    Group group;
    group.first = taps_[begin].index;
    if (group.first + kGroupReach > source_width) break;
    for (int i = 0; i < kGroupSize; ++i) {
      const Tap& tap = taps_[begin + i];
      const int offset = tap.index - group.first;
      if (offset + 1 >= kGroupReach) return;
      group.neighbours[2 * i] = static_cast<std::uint8_t>(offset);
      group.neighbours[2 * i + 1] = static_cast<std::uint8_t>(offset + 1);
      group.weights[2 * i] = static_cast<std::uint8_t>(tap.weight);
      group.weights[2 * i + 1] = static_cast<std::uint8_t>(tap.weight_next);
    }
    groups_.push_back(group);
  }
}

void RowShrinker::Shrink(const std::uint8_t* row, std::int16_t* out) const {
  ShrinkGroups(row, out);
  for (std::size_t x = groups_.size() * kGroupSize; x < taps_.size(); ++x) {
    const Tap& tap = taps_[x];
    out[x] = static_cast<std::int16_t>(row[tap.index] * tap.weight +
                                       row[tap.index + 1] * tap.weight_next);
  }
}

#if defined(__x86_64__)
// The product of unsigned and signed bytes takes the pixels as signed ones, 128 lower. The two
// weights sum to kTapOne, so that this lowers each result by the same amount, which is added again.
__attribute__((target("ssse3"))) void RowShrinker::ShrinkGroups(const std::uint8_t* row,
                                                                std::int16_t* out) const {
  const __m128i signs = _mm_set1_epi8(-128);
  const __m128i lowered_by = _mm_set1_epi16(128 * kTapOne);
  const auto load = [](const std::uint8_t* bytes) __attribute__((target("ssse3"))) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes));
  };
  for (const Group& group : groups_) {
    const __m128i pixels = _mm_shuffle_epi8(load(row + group.first), load(group.neighbours.data()));
    const __m128i sums =
        _mm_maddubs_epi16(load(group.weights.data()), _mm_xor_si128(pixels, signs));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out), _mm_add_epi16(sums, lowered_by));
    out += kGroupSize;
  }
}
#else
void RowShrinker::ShrinkGroups(const std::uint8_t*, std::int16_t*) const {}
#endif

}  // namespace semslam

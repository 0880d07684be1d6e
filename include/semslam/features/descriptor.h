// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#if defined(__SSE2__) && !defined(__POPCNT__)
#include <emmintrin.h>
#endif

namespace semslam {

// The 256 bits of an ORB feature; in memory the same 32 bytes as a row of OpenCV's descriptor
// matrix.
struct Descriptor {
  std::array<std::uint64_t, 4> bits{};
  friend bool operator==(const Descriptor&, const Descriptor&) = default;
};
static_assert(std::endian::native == std::endian::little && sizeof(Descriptor) == 32);

inline constexpr int kDescriptorBits = 256;

// Number of bits that differ, 0 ... 256.
inline int HammingDistance(const Descriptor& a, const Descriptor& b) {
#if defined(__SSE2__) && !defined(__POPCNT__)
  // x86-64 without extensions has no instruction that counts bits: count in pairs, then in nibbles,
  // both halves at once (Warren, "Hacker's Delight", section 5-1), and let psadbw add the bytes.
  const auto count_nibbles = [](__m128i x) {
    const __m128i odd = _mm_and_si128(_mm_srli_epi64(x, 1), _mm_set1_epi8(0x55));
    const __m128i pairs = _mm_sub_epi8(x, odd);
    const __m128i mask = _mm_set1_epi8(0x33);
    return _mm_add_epi8(_mm_and_si128(pairs, mask), _mm_and_si128(_mm_srli_epi64(pairs, 2), mask));
  };
  const auto load = [](const Descriptor& d, int half) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(d.bits.data()) + half);
  };
  const __m128i nibbles = _mm_add_epi8(count_nibbles(_mm_xor_si128(load(a, 0), load(b, 0))),
                                       count_nibbles(_mm_xor_si128(load(a, 1), load(b, 1))));
  const __m128i mask = _mm_set1_epi8(0x0f);
  const __m128i bytes =
      _mm_add_epi8(_mm_and_si128(nibbles, mask), _mm_and_si128(_mm_srli_epi64(nibbles, 4), mask));
  const __m128i sums = _mm_sad_epu8(bytes, _mm_setzero_si128());
  return _mm_cvtsi128_si32(_mm_add_epi64(sums, _mm_unpackhi_epi64(sums, sums)));
#else
  int distance = 0;
  for (int i = 0; i < 4; ++i) distance += std::popcount(a.bits[i] ^ b.bits[i]);
  return distance;
#endif
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace semslam {

// Noise that depends on where it is asked for, not on the order of asking: so pixels can be
// computed in any order, on any number of threads.

// Mixes the bits of a number (the finaliser of SplitMix64).
constexpr std::uint64_t MixBits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

constexpr std::uint64_t HashOf(std::uint64_t seed, std::uint64_t a, std::uint64_t b = 0) {
  return MixBits(MixBits(seed ^ (a * 0xd6e8feb86659fd93ULL)) ^ b);
}

// In [0, 1), from the high bits.
constexpr float UnitFloat(std::uint64_t hash) {
  return static_cast<float>(hash >> 40) * 0x1.0p-24F;
}

// Nearly normal with mean 0 and standard deviation 1: the sum of four 16-bit uniform numbers;
// never beyond 3.47.
constexpr float NormalFloat(std::uint64_t hash) {
  const std::uint64_t sum =
      (hash & 0xffffU) + ((hash >> 16) & 0xffffU) + ((hash >> 32) & 0xffffU) + (hash >> 48);
  // Mean 2 * 65535, variance 4 * (65536^2 - 1) / 12.
  return (static_cast<float>(sum) - 131070.0F) * (1.0F / 37837.22F);
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>

namespace semslam {

// A small seeded generator (SplitMix64) whose sequence is the same on every platform and library,
// unlike the distributions of <random>. Not for cryptography.
class Random {
 public:
  using result_type = std::uint64_t;

  explicit Random(std::uint64_t seed) : state_(seed) {}

  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return std::numeric_limits<result_type>::max(); }

  result_type operator()();

  // In [0, 1).
  double Uniform();
  double Uniform(double low, double high) { return low + (high - low) * Uniform(); }
  // In [0, count); count > 0.
  std::uint32_t Index(std::uint32_t count);
  // Mean 0, standard deviation 1.
  double Gaussian();

 private:
  std::uint64_t state_;
};

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/base/random.h"

#include <cmath>
#include <numbers>

namespace semslam {

Random::result_type Random::operator()() {
  // Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014.
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

double Random::Uniform() { return static_cast<double>((*this)() >> 11) * 0x1.0p-53; }

std::uint32_t Random::Index(std::uint32_t count) {
  return static_cast<std::uint32_t>(((*this)() >> 32) * count >> 32);
}

double Random::Gaussian() {
  // Box and Muller; the second value is thrown away so that the state stays one number.
  const double radius = std::sqrt(-2.0 * std::log(1.0 - Uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * Uniform());
}

}  // namespace semslam

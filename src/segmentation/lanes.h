// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>
#include <emmintrin.h>

namespace semslam {

// Four oriented points side by side, for what is done with all four at once (SSE2, which every
// x86-64 has).
struct FourPoints {
  alignas(16) std::array<float, 4> x{};
  alignas(16) std::array<float, 4> y{};
  alignas(16) std::array<float, 4> z{};
  alignas(16) std::array<float, 4> normal_x{};
  alignas(16) std::array<float, 4> normal_y{};
  alignas(16) std::array<float, 4> normal_z{};

  void Set(std::size_t lane, const Eigen::Vector3f& position, const Eigen::Vector3f& normal) {
    x[lane] = position.x();
    y[lane] = position.y();
    z[lane] = position.z();
    normal_x[lane] = normal.x();
    normal_y[lane] = normal.y();
    normal_z[lane] = normal.z();
  }
};

inline __m128 Absolute(__m128 a) { return _mm_andnot_ps(_mm_set1_ps(-0.0F), a); }

// `yes` where all bits of the mask are set, `no` where none is.
inline __m128 Choose(__m128 mask, __m128 yes, __m128 no) {
  return _mm_or_ps(_mm_and_ps(mask, yes), _mm_andnot_ps(mask, no));
}

inline __m128 Dot(__m128 ax, __m128 ay, __m128 az, __m128 bx, __m128 by, __m128 bz) {
  return _mm_add_ps(_mm_add_ps(_mm_mul_ps(ax, bx), _mm_mul_ps(ay, by)), _mm_mul_ps(az, bz));
}

}  // namespace semslam

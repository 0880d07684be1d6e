// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <emmintrin.h>

namespace semslam {

// Four floats that are computed together (SSE2, which every x86-64 has): neighbouring pixels of a
// row, or the samples of one pixel.
struct Float4 {
  __m128 lanes;

  Float4() : lanes(_mm_setzero_ps()) {}
  Float4(float value) : lanes(_mm_set1_ps(value)) {}  // NOLINT(google-explicit-constructor)
  explicit Float4(__m128 value) : lanes(value) {}

  static Float4 Load(const float* values) { return Float4(_mm_loadu_ps(values)); }
  void Store(float* values) const { _mm_storeu_ps(values, lanes); }

  Float4& operator+=(Float4 b) { return *this = Float4(_mm_add_ps(lanes, b.lanes)); }
};

inline Float4 operator+(Float4 a, Float4 b) { return Float4(_mm_add_ps(a.lanes, b.lanes)); }
inline Float4 operator-(Float4 a, Float4 b) { return Float4(_mm_sub_ps(a.lanes, b.lanes)); }
inline Float4 operator*(Float4 a, Float4 b) { return Float4(_mm_mul_ps(a.lanes, b.lanes)); }
inline Float4 operator/(Float4 a, Float4 b) { return Float4(_mm_div_ps(a.lanes, b.lanes)); }
inline Float4 Min(Float4 a, Float4 b) { return Float4(_mm_min_ps(a.lanes, b.lanes)); }
inline Float4 Max(Float4 a, Float4 b) { return Float4(_mm_max_ps(a.lanes, b.lanes)); }
inline Float4 Sqrt(Float4 a) { return Float4(_mm_sqrt_ps(a.lanes)); }
inline Float4 Abs(Float4 a) { return Float4(_mm_andnot_ps(_mm_set1_ps(-0.0F), a.lanes)); }
// 1 or -1.
inline Float4 SignOf(Float4 a) {
  const __m128 sign = _mm_and_ps(_mm_set1_ps(-0.0F), a.lanes);
  return Float4(_mm_or_ps(sign, _mm_set1_ps(1.0F)));
}
// One bit a lane.
inline int LessBits(Float4 a, Float4 b) { return _mm_movemask_ps(_mm_cmplt_ps(a.lanes, b.lanes)); }
// Where a < b, `yes`; else 0.
inline Float4 IfLess(Float4 a, Float4 b, Float4 yes) {
  return Float4(_mm_and_ps(_mm_cmplt_ps(a.lanes, b.lanes), yes.lanes));
}

// Four points or directions.
struct Vector4 {
  Float4 x;
  Float4 y;
  Float4 z;
};

inline Vector4 operator+(const Vector4& a, const Vector4& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vector4 operator-(const Vector4& a, const Vector4& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vector4 operator*(Float4 a, const Vector4& b) { return {a * b.x, a * b.y, a * b.z}; }
inline Float4 Dot(const Vector4& a, const Vector4& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// A list of numbers that may be read and written four or eight at a time at any place: there is
// room behind the last one.
class FloatRow {
 public:
  static constexpr std::size_t kRoom = 8;

  void Resize(std::size_t size) { values_.resize(size + kRoom); }
  float* data() { return values_.data(); }
  const float* data() const { return values_.data(); }
  float& operator[](std::size_t index) { return values_[index]; }
  float operator[](std::size_t index) const { return values_[index]; }
  Float4 At(std::size_t index) const { return Float4::Load(values_.data() + index); }
  void Set(std::size_t index, Float4 value) { value.Store(values_.data() + index); }

 private:
  std::vector<float> values_;
};

// A list of vectors.
struct VectorRow {
  FloatRow x;
  FloatRow y;
  FloatRow z;

  void Resize(std::size_t size) {
    for (FloatRow* row : {&x, &y, &z}) row->Resize(size);
  }
  Vector4 At(std::size_t index) const { return {x.At(index), y.At(index), z.At(index)}; }
  void Set(std::size_t index, const Vector4& value) {
    x.Set(index, value.x);
    y.Set(index, value.y);
    z.Set(index, value.z);
  }
};

}  // namespace semslam

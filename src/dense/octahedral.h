// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Core>

namespace semslam {

// A unit vector in two bytes: the sphere is projected to the octahedron |x|+|y|+|z| = 1, whose
// lower half is folded out into the corners of the square [-1, 1]^2. Error below 1 degree.
struct OctahedralNormal {
  std::uint8_t u = 0;
  std::uint8_t v = 0;
};

inline OctahedralNormal EncodeNormal(const Eigen::Vector3f& normal) {
  const float length = normal.cwiseAbs().sum();
  float x = normal.x() / length;
  float y = normal.y() / length;
  if (normal.z() < 0) {
    const float folded_x = std::copysign(1.0F - std::abs(y), x);
    y = std::copysign(1.0F - std::abs(x), y);
    x = folded_x;
  }
  const auto quantise = [](float value) {
    return static_cast<std::uint8_t>(std::clamp((value + 1.0F) * 127.0F + 0.5F, 0.0F, 254.0F));
  };
  return {quantise(x), quantise(y)};
}

inline Eigen::Vector3f DecodeNormal(OctahedralNormal code) {
  constexpr float kScale = 1.0F / 127.0F;
  float x = static_cast<float>(code.u) * kScale - 1.0F;
  float y = static_cast<float>(code.v) * kScale - 1.0F;
  const float z = 1.0F - std::abs(x) - std::abs(y);
  const float fold = std::max(-z, 0.0F);
  x -= std::copysign(fold, x);
  y -= std::copysign(fold, y);
  return Eigen::Vector3f(x, y, z).normalized();
}

}  // namespace semslam

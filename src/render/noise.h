// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "semslam/render/hash.h"

namespace semslam {

// Noise that patterns are drawn with.

inline float SmoothStep(float t) { return t * t * (3.0F - 2.0F * t); }

// Value noise that repeats over the unit square: random values at `period` x `period` points, and a
// smooth surface through them.
class ValueNoise {
 public:
  ValueNoise(std::uint64_t seed, const Eigen::Vector2i& period) : period_(period) {
    for (int y = 0; y < period.y(); ++y) {
      for (int x = 0; x < period.x(); ++x) {
        values_.push_back(
            UnitFloat(HashOf(seed, static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y))));
      }
    }
  }

  // In [0, 1], at a point of [0, 1) x [0, 1).
  float At(const Eigen::Vector2f& unit) const {
    const Eigen::Vector2f at = unit.cwiseProduct(period_.cast<float>());
    const int x0 = std::min(static_cast<int>(at.x()), period_.x() - 1);
    const int y0 = std::min(static_cast<int>(at.y()), period_.y() - 1);
    const int x1 = x0 + 1 == period_.x() ? 0 : x0 + 1;
    const int y1 = y0 + 1 == period_.y() ? 0 : y0 + 1;
    const float wx = SmoothStep(at.x() - static_cast<float>(x0));
    const float wy = SmoothStep(at.y() - static_cast<float>(y0));
    const float top = Value(x0, y0) * (1 - wx) + Value(x1, y0) * wx;
    const float bottom = Value(x0, y1) * (1 - wx) + Value(x1, y1) * wx;
    return top * (1 - wy) + bottom * wy;
  }

 private:
  float Value(int x, int y) const { return values_[static_cast<std::size_t>(y) * period_.x() + x]; }

  Eigen::Vector2i period_;
  std::vector<float> values_;
};

// Sum of octaves of value noise, in about [-1, 1].
class FractalNoise {
 public:
  FractalNoise(std::uint64_t seed, Eigen::Vector2i period, int num_octaves, float roughness) {
    float strength = 1;
    for (int octave = 0; octave < num_octaves; ++octave) {
      octaves_.push_back({ValueNoise(seed + octave, period), strength});
      total_ += strength;
      strength *= roughness;
      period *= 2;
    }
  }

  float At(const Eigen::Vector2f& unit) const {
    constexpr float kSpread = 1.6F;  // Sums of octaves seldom come near their limits.
    float sum = 0;
    for (const auto& [noise, strength] : octaves_) sum += strength * (2.0F * noise.At(unit) - 1.0F);
    return kSpread * sum / total_;
  }

 private:
  std::vector<std::pair<ValueNoise, float>> octaves_;
  float total_ = 0;
};

inline cv::Vec3b ToPixel(const Eigen::Vector3f& color, float brightness) {
  cv::Vec3b pixel;
  for (int k = 0; k < 3; ++k) {
    pixel[k] =
        static_cast<std::uint8_t>(std::clamp(color[k] * brightness * 255.0F + 0.5F, 0.0F, 255.0F));
  }
  return pixel;
}

// Calls color(position in the unit square) for each pixel.
template <typename Color>
cv::Mat PaintPixels(cv::Size size, const Color& color) {
  cv::Mat image(size, CV_8UC3);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      image.at<cv::Vec3b>(y, x) =
          color(Eigen::Vector2f(static_cast<float>(x) / static_cast<float>(size.width),
                                static_cast<float>(y) / static_cast<float>(size.height)));
    }
  }
  return image;
}

}  // namespace semslam

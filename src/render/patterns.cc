// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/patterns.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <opencv2/imgproc.hpp>

#include "semslam/base/random.h"
#include "semslam/render/hash.h"

#include "render/drawing.h"

namespace semslam {
namespace {

float LatticeValue(std::uint64_t seed, int x, int y) {
  return UnitFloat(HashOf(seed, static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y)));
}

float SmoothStep(float t) { return t * t * (3.0F - 2.0F * t); }

// Value noise in [0, 1] that repeats after `period` in each direction.
float ValueNoise(std::uint64_t seed, const Eigen::Vector2f& at, const Eigen::Vector2i& period) {
  const int x0 = static_cast<int>(std::floor(at.x()));
  const int y0 = static_cast<int>(std::floor(at.y()));
  const float wx = SmoothStep(at.x() - static_cast<float>(x0));
  const float wy = SmoothStep(at.y() - static_cast<float>(y0));
  const auto value = [&](int x, int y) {
    return LatticeValue(seed, (x % period.x() + period.x()) % period.x(),
                        (y % period.y() + period.y()) % period.y());
  };
  const float top = value(x0, y0) * (1 - wx) + value(x0 + 1, y0) * wx;
  const float bottom = value(x0, y0 + 1) * (1 - wx) + value(x0 + 1, y0 + 1) * wx;
  return top * (1 - wy) + bottom * wy;
}

// Sum of octaves, in about [-1, 1]. `unit`: position in [0, 1) x [0, 1).
float FractalNoise(std::uint64_t seed,
                   const Eigen::Vector2f& unit,
                   Eigen::Vector2i period,
                   int num_octaves,
                   float roughness) {
  float sum = 0;
  float total = 0;
  float strength = 1;
  for (int octave = 0; octave < num_octaves; ++octave) {
    sum +=
        strength *
        (2.0F * ValueNoise(seed + octave, unit.cwiseProduct(period.cast<float>()), period) - 1.0F);
    total += strength;
    strength *= roughness;
    period *= 2;
  }
  return sum / total * 1.6F;
}

cv::Vec3b ToPixel(const Eigen::Vector3f& color, float brightness) {
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

}  // namespace

cv::Mat DrawNoise(cv::Size size, const NoiseStyle& style, std::uint64_t seed) {
  return PaintPixels(size, [&](const Eigen::Vector2f& unit) {
    const float noise = FractalNoise(seed, unit, Eigen::Vector2i::Constant(style.period),
                                     style.num_octaves, style.roughness);
    return ToPixel(style.color, 1.0F + style.contrast * noise);
  });
}

cv::Mat DrawWood(cv::Size size, const Eigen::Vector3f& color, std::uint64_t seed) {
  return PaintPixels(size, [&](const Eigen::Vector2f& unit) {
    // Rings of a trunk cut along its axis, bent by slow noise, with fine pores along the grain.
    const float bend = FractalNoise(seed, unit, {2, 3}, 3, 0.5F);
    const float ring = std::sin(2.0F * std::numbers::pi_v<float> * (9.0F * unit.y() + 1.5F * bend));
    const float pores = FractalNoise(seed + 50, unit, {12, 150}, 2, 0.7F);
    const float knots = FractalNoise(seed + 90, unit, {40, 60}, 2, 0.5F);
    const float dark = knots > 0.75F ? 0.25F : 0.0F;
    return ToPixel(color, 1.0F + 0.10F * ring + 0.16F * pores + 0.06F * bend - dark);
  });
}

cv::Mat DrawCarpet(cv::Size size, const Eigen::Vector3f& color, std::uint64_t seed) {
  return PaintPixels(size, [&](const Eigen::Vector2f& unit) {
    const float fleck = ValueNoise(seed, unit * 90.0F, {90, 90});
    const float loops = ValueNoise(seed + 1, unit * 200.0F, {200, 200});
    const float stains = FractalNoise(seed + 2, unit, {5, 5}, 3, 0.5F);
    const float brightness = fleck > 0.78F ? 1.5F : (fleck < 0.2F ? 0.6F : 1.0F);
    return ToPixel(color, brightness * (0.8F + 0.4F * loops) + 0.1F * stains);
  });
}

cv::Mat DrawFur(cv::Size size, const Eigen::Vector3f& color, std::uint64_t seed) {
  cv::Mat image(size, CV_8UC3, ToScalar(color * 0.75F));
  Random random(seed);
  const int num_strokes = size.area() / 14;
  for (int i = 0; i < num_strokes; ++i) {
    const cv::Point from(static_cast<int>(random.Index(size.width)),
                         static_cast<int>(random.Index(size.height)));
    const double angle = random.Uniform(0, 2 * std::numbers::pi);
    const double length = random.Uniform(4, 10);
    const cv::Point along(cvRound(length * std::cos(angle)), cvRound(length * std::sin(angle)));
    const cv::Scalar shade = ToScalar(color * static_cast<float>(random.Uniform(0.6, 1.35)));
    for (const int dx : {0, -size.width, size.width}) {  // Strokes that leave come in again.
      for (const int dy : {0, -size.height, size.height}) {
        const cv::Point shift(dx, dy);
        cv::line(image, from + shift, from + along + shift, shade, 1, cv::LINE_AA);
      }
    }
  }
  return image;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/patterns.h"

#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>

#include "semslam/base/random.h"

#include "render/drawing.h"
#include "render/noise.h"

namespace semslam {

cv::Mat DrawNoise(cv::Size size, const NoiseStyle& style, std::uint64_t seed) {
  const FractalNoise noise(seed, Eigen::Vector2i::Constant(style.period), style.num_octaves,
                           style.roughness);
  return PaintPixels(size, [&](const Eigen::Vector2f& unit) {
    return ToPixel(style.color, 1.0F + style.contrast * noise.At(unit));
  });
}

cv::Mat DrawWood(cv::Size size, const Eigen::Vector3f& color, std::uint64_t seed) {
  // Rings of a trunk cut along its axis, bent by slow noise, with fine pores along the grain.
  const FractalNoise bend_noise(seed, {2, 3}, 3, 0.5F);
  const FractalNoise pore_noise(seed + 50, {12, 150}, 2, 0.7F);
  const FractalNoise knot_noise(seed + 90, {40, 60}, 2, 0.5F);
  return PaintPixels(size, [&](const Eigen::Vector2f& unit) {
    const float bend = bend_noise.At(unit);
    const float ring = std::sin(2.0F * std::numbers::pi_v<float> * (9.0F * unit.y() + 1.5F * bend));
    const float dark = knot_noise.At(unit) > 0.75F ? 0.14F : 0.0F;
    return ToPixel(color, 1.0F + 0.08F * ring + 0.11F * pore_noise.At(unit) + 0.06F * bend - dark);
  });
}

cv::Mat DrawCarpet(cv::Size size, const Eigen::Vector3f& color, std::uint64_t seed) {
  const ValueNoise fleck_noise(seed, {90, 90});
  const ValueNoise loops(seed + 1, {200, 200});
  const FractalNoise stains(seed + 2, {5, 5}, 3, 0.5F);
  return PaintPixels(size, [&](const Eigen::Vector2f& unit) {
    const float fleck = fleck_noise.At(unit);
    const float brightness = fleck > 0.78F ? 1.5F : (fleck < 0.2F ? 0.6F : 1.0F);
    return ToPixel(color, brightness * (0.8F + 0.4F * loops.At(unit)) + 0.1F * stains.At(unit));
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

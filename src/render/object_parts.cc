// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/object_parts.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "semslam/render/patterns.h"

namespace semslam {

cv::Size PixelsFor(float width, float height, float pixels_per_metre) {
  constexpr float kLargest = 1024;
  const float scale = std::min(pixels_per_metre, kLargest / std::max(width, height));
  return {std::max(8, cvRound(width * scale)), std::max(8, cvRound(height * scale))};
}

Material Printed(Picture picture, float width, float height) {
  Material material;
  material.picture = std::make_shared<const Picture>(std::move(picture));
  material.repeats_per_metre = {1.0F / width, 1.0F / height};
  return material;
}

Material Plastic(const Eigen::Vector3f& color, float specular) {
  Material material;
  material.tint = color;
  material.specular = specular;
  return material;
}

Material GrainyPlastic(const Eigen::Vector3f& color, std::uint64_t seed) {
  const NoiseStyle style = {
      .color = color, .contrast = 0.06F, .period = 24, .num_octaves = 3, .roughness = 0.8F};
  Material material = Printed([=] { return DrawNoise({128, 128}, style, seed); }, 0.12F, 0.12F);
  material.specular = 0.08F;
  material.shininess = 15;
  return material;
}

Material Wooden(const Eigen::Vector3f& color, std::uint64_t seed) {
  Material material = Printed([=] { return DrawWood({1024, 512}, color, seed); }, 1.2F, 0.6F);
  material.specular = 0.05F;
  return material;
}

Material Woven(const Eigen::Vector3f& color, std::uint64_t seed) {
  return Printed(
      [=] {
        return DrawFabric({256, 256}, color, 0.7F * color, 0.3F, seed);
      },
      0.2F, 0.2F);
}

std::vector<Eigen::Vector3f> SmoothLine(const std::vector<Eigen::Vector3f>& points) {
  constexpr int kSteps = 5;  // From point to point.
  std::vector<Eigen::Vector3f> line;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Eigen::Vector3f& before = points[i > 0 ? i - 1 : 0];
    const Eigen::Vector3f& after = points[std::min(i + 2, points.size() - 1)];
    const Eigen::Vector3f slope0 = 0.5F * (points[i + 1] - before);
    const Eigen::Vector3f slope1 = 0.5F * (after - points[i]);
    for (int k = 0; k < kSteps; ++k) {
      const float t = static_cast<float>(k) / kSteps;
      const float rise = t * t * (3 - 2 * t);
      line.emplace_back((1 - rise) * points[i] + rise * points[i + 1] +
                        t * (1 - t) * (1 - t) * slope0 - t * t * (1 - t) * slope1);
    }
  }
  line.push_back(points.back());
  return line;
}

TriangleMesh BoxOn(const Eigen::Vector3f& size, const Eigen::Vector3f& bottom) {
  return Translated(MakeBox(size), bottom + Eigen::Vector3f(0, 0, 0.5F * size.z()));
}

TriangleMesh RoundedBoxOn(const Eigen::Vector3f& size,
                          float radius,
                          const Eigen::Vector3f& bottom) {
  return Translated(MakeRoundedBox(size, std::min(radius, 0.499F * size.minCoeff())),
                    bottom + Eigen::Vector3f(0, 0, 0.5F * size.z()));
}

TriangleMesh MakeUpright(float width, float height, const Eigen::Vector3f& center) {
  return Placed(MakeRectangle(width, height), {0.5F * std::numbers::pi_v<float>, 0, 0}, center);
}

TriangleMesh Placed(TriangleMesh mesh,
                    const Eigen::Vector3f& rotation_vector,
                    const Eigen::Vector3f& offset) {
  return Transformed(std::move(mesh),
                     {ExpSO3(rotation_vector.cast<double>()), offset.cast<double>()});
}

}  // namespace semslam

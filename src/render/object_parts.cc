// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/object_parts.h"

#include <numbers>
#include <utility>

#include "semslam/render/patterns.h"

namespace semslam {

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

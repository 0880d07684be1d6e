// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/shading.h"

#include <cmath>

namespace semslam {
namespace {

using Lanes = std::array<float, 4>;

Vector4 Broadcast(const Eigen::Vector3f& value) { return {value.x(), value.y(), value.z()}; }

Vector4 Normalized(const Vector4& value) { return Float4(1.0F) / Sqrt(Dot(value, value)) * value; }

// What the four points are made of.
struct Coat {
  Vector4 albedo;  // Linear. 0 where there is no surface.
  std::array<const Material*, 4> materials = {};
  Float4 emission;
  bool has_highlights = false;
};

// Surface colour, linear. Colours are coded with gamma 2, so that decoding is a square.
Eigen::Vector3f Albedo(const Material& material, const SurfacePoints& points, std::size_t index) {
  Eigen::Vector3f coded = material.tint;
  if (material.texture) {
    const Eigen::Vector2f uv(points.u[index] * material.repeats_per_metre.x(),
                             points.v[index] * material.repeats_per_metre.y());
    const float footprint = points.footprint[index] * material.repeats_per_metre.x();
    coded = coded.cwiseProduct(material.texture->Sample(uv, footprint));
  }
  return coded.cwiseProduct(coded);
}

Coat CoatOf(const Scene& scene, const SurfacePoints& points, std::size_t index) {
  Coat coat;
  std::array<Lanes, 3> albedo = {};
  Lanes emission = {};
  for (std::size_t lane = 0; lane < 4; ++lane) {
    const std::uint32_t part = points.part[index + lane];
    if (part == Hit::kNone) continue;
    const Material& material = scene.parts()[part].material;
    const Eigen::Vector3f color = Albedo(material, points, index + lane);
    for (int k = 0; k < 3; ++k) albedo[k][lane] = color[k];
    emission[lane] = material.emission;
    coat.materials[lane] = &material;
    coat.has_highlights |= material.specular > 0;
  }
  coat.albedo = {Float4::Load(albedo[0].data()), Float4::Load(albedo[1].data()),
                 Float4::Load(albedo[2].data())};
  coat.emission = Float4::Load(emission.data());
  return coat;
}

// Blinn's highlight of each point as a part of the arriving light. `alignment`: cosine between the
// normal and the middle of the directions to lamp and viewer.
Float4 Highlight(const Coat& coat, Float4 alignment) {
  Lanes cosines;
  alignment.Store(cosines.data());
  Lanes strengths = {};
  for (std::size_t lane = 0; lane < 4; ++lane) {
    const Material* material = coat.materials[lane];
    if (material == nullptr || material->specular <= 0) continue;
    const float shininess = material->shininess;
    if (cosines[lane] * shininess < shininess - 7.0F) continue;  // Below 0.1 %.
    if (cosines[lane] <= 0) continue;
    strengths[lane] = material->specular * std::pow(cosines[lane], shininess);
  }
  return Float4::Load(strengths.data());
}

}  // namespace

Vector4 Shade(const Scene& scene,
              const SurfacePoints& points,
              std::size_t index,
              const Eigen::Vector3f& p_world_viewer,
              const Lighting& lighting) {
  const Coat coat = CoatOf(scene, points, index);
  const Vector4 p_world = points.p_world.At(index);
  const Vector4 normal = points.normal.At(index);
  const Vector4 to_viewer = Normalized(Broadcast(p_world_viewer) - p_world);
  const Float4 up = Float4(0.5F) + Float4(0.5F) * normal.z;
  const Vector4 below = Broadcast(scene.ambient_below());
  Vector4 diffuse =
      lighting[kMaxLights] * (below + up * (Broadcast(scene.ambient_above()) - below));
  Vector4 highlight;
  for (std::size_t i = 0; i < scene.lights().size(); ++i) {
    const Light& light = scene.lights()[i];
    const Vector4 to_light = Broadcast(light.p_world) - p_world;
    const Float4 squared_distance = Dot(to_light, to_light);
    const Vector4 direction = Float4(1.0F) / Sqrt(squared_distance) * to_light;
    const Float4 facing = Max(Dot(normal, direction), 0.0F);
    const Vector4 arriving = lighting[i] * facing / squared_distance * Broadcast(light.intensity);
    diffuse = diffuse + arriving;
    if (!coat.has_highlights || LessBits(0.0F, facing) == 0) continue;
    const Float4 alignment = Dot(normal, Normalized(direction + to_viewer));
    highlight = highlight + Highlight(coat, alignment) * arriving;
  }
  const auto color = [&](Float4 albedo, Float4 arriving, Float4 shine) {
    return albedo * (arriving + coat.emission) + shine;
  };
  return {color(coat.albedo.x, diffuse.x, highlight.x),
          color(coat.albedo.y, diffuse.y, highlight.y),
          color(coat.albedo.z, diffuse.z, highlight.z)};
}

}  // namespace semslam

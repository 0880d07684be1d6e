// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/shading.h"

#include <bit>
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

// Surface colour, linear, of four points of one material. Colours are coded with gamma 2, so that
// decoding is a square.
Vector4 Albedo(const Material& material, const SurfacePoints& points, std::size_t index) {
  Vector4 coded = Broadcast(material.tint);
  if (material.texture) {
    const Float4 repeats_u = material.repeats_per_metre.x();
    const Float4 repeats_v = material.repeats_per_metre.y();
    const Texture::Colors colors = material.texture->Sample(
        {(points.u.At(index) * repeats_u).lanes, (points.v.At(index) * repeats_v).lanes,
         (points.footprint.At(index) * repeats_u).lanes});
    coded = {coded.x * Float4(colors.blue), coded.y * Float4(colors.green),
             coded.z * Float4(colors.red)};
  }
  return {coded.x * coded.x, coded.y * coded.y, coded.z * coded.z};
}

Coat CoatOf(const Scene& scene, const SurfacePoints& points, std::size_t index) {
  Coat coat;
  const __m128i parts = _mm_loadu_si128(reinterpret_cast<const __m128i*>(&points.part[index]));
  const auto seen_of = [&](std::uint32_t part) {
    return _mm_castsi128_ps(_mm_cmpeq_epi32(parts, _mm_set1_epi32(static_cast<int>(part))));
  };
  unsigned left = ~static_cast<unsigned>(_mm_movemask_ps(seen_of(Hit::kNone))) & 0xfU;
  while (left != 0) {  // Mostly once: all four are points of one part.
    const std::uint32_t part = points.part[index + std::countr_zero(left)];
    const __m128 seen = seen_of(part);
    const auto lanes = static_cast<unsigned>(_mm_movemask_ps(seen));
    left &= ~lanes;
    const Material& material = scene.parts()[part].material;
    const auto where_seen = [&](Float4 value) { return Float4(_mm_and_ps(seen, value.lanes)); };
    const Vector4 albedo = Albedo(material, points, index);
    coat.albedo.x += where_seen(albedo.x);
    coat.albedo.y += where_seen(albedo.y);
    coat.albedo.z += where_seen(albedo.z);
    coat.emission += where_seen(material.emission);
    coat.has_highlights |= material.specular > 0;
    for (std::size_t lane = 0; lane < 4; ++lane) {
      if ((lanes >> lane & 1U) != 0) coat.materials[lane] = &material;
    }
  }
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

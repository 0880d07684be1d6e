// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/shading.h"

#include <algorithm>
#include <cmath>

namespace semslam {
namespace {

// Surface colour, linear. Colours are coded with gamma 2, so that decoding is a square.
Eigen::Vector3f Albedo(const Material& material, const SurfacePoint& point) {
  Eigen::Vector3f coded = material.tint;
  if (material.texture) {
    const Eigen::Vector2f uv = point.uv.cwiseProduct(material.repeats_per_metre);
    const float footprint = point.footprint * material.repeats_per_metre.x();
    coded = coded.cwiseProduct(material.texture->Sample(uv, footprint));
  }
  return coded.cwiseProduct(coded);
}

}  // namespace

SurfacePoint LocateHit(const Scene& scene, const Hit& hit, const Ray& ray, float pixel_angle) {
  SurfacePoint point;
  if (hit.part == Hit::kNone) return point;
  const TriangleMesh& mesh = scene.parts()[hit.part].mesh;
  const Eigen::Vector3i& corners = mesh.triangles[hit.triangle];
  const float w = 1.0F - hit.u - hit.v;
  const Eigen::Vector3f& a = mesh.positions[corners[0]];
  const Eigen::Vector3f& b = mesh.positions[corners[1]];
  const Eigen::Vector3f& c = mesh.positions[corners[2]];
  point.part = hit.part;
  point.p_world = ray.origin + hit.distance * ray.direction;
  point.face_normal = (b - a).cross(c - a).normalized();
  point.normal = (w * mesh.normals[corners[0]] + hit.u * mesh.normals[corners[1]] +
                  hit.v * mesh.normals[corners[2]])
                     .normalized();
  point.uv = w * mesh.uvs[corners[0]] + hit.u * mesh.uvs[corners[1]] + hit.v * mesh.uvs[corners[2]];
  const float ray_norm = ray.direction.norm();
  float cosine = -point.face_normal.dot(ray.direction) / ray_norm;
  if (cosine < 0) {  // Seen from behind.
    cosine = -cosine;
    point.face_normal = -point.face_normal;
    point.normal = -point.normal;
  }
  point.incidence = std::min(cosine, 1.0F);
  // Between the patch's short and long side, as a texture sample is round and the patch is not.
  // Half a pixel more than the patch: lenses of such cameras are soft.
  point.footprint =
      1.5F * hit.distance * ray_norm * pixel_angle / std::sqrt(std::max(cosine, 0.05F));
  return point;
}

Eigen::Vector3f Shade(const Scene& scene,
                      const SurfacePoint& point,
                      const Eigen::Vector3f& p_world_viewer,
                      const Lighting& lighting) {
  if (point.part == Hit::kNone) return Eigen::Vector3f::Zero();
  const Material& material = scene.parts()[point.part].material;
  const Eigen::Vector3f to_viewer = (p_world_viewer - point.p_world).normalized();
  const float up = 0.5F * (1.0F + point.normal.z());
  Eigen::Vector3f diffuse =
      lighting[kMaxLights] *
      (scene.ambient_below() + up * (scene.ambient_above() - scene.ambient_below()));
  Eigen::Vector3f highlight = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < scene.lights().size(); ++i) {
    const Light& light = scene.lights()[i];
    const Eigen::Vector3f to_light = light.p_world - point.p_world;
    const float squared_distance = to_light.squaredNorm();
    const Eigen::Vector3f direction = to_light / std::sqrt(squared_distance);
    const float facing = point.normal.dot(direction);
    if (facing <= 0) continue;
    const Eigen::Vector3f arriving =
        light.intensity * (lighting[static_cast<int>(i)] * facing / squared_distance);
    diffuse += arriving;
    if (material.specular <= 0) continue;
    const float alignment = std::max(0.0F, point.normal.dot((direction + to_viewer).normalized()));
    if (alignment * material.shininess < material.shininess - 7.0F) continue;  // Below 0.1 %.
    highlight += arriving * (material.specular * std::pow(alignment, material.shininess));
  }
  const Eigen::Vector3f albedo = Albedo(material, point);
  return albedo.cwiseProduct(diffuse) + highlight + material.emission * albedo;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "semslam/render/scene.h"

#include "render/ray_scene.h"

namespace semslam {

// A point where a line of sight meets the scene.
struct SurfacePoint {
  std::uint32_t part = Hit::kNone;  // Index into Scene::parts; kNone: nothing there.
  Eigen::Vector3f p_world;
  Eigen::Vector3f face_normal;  // Of the triangle, towards the viewer.
  Eigen::Vector3f normal;       // For shading: interpolated, towards the viewer.
  Eigen::Vector2f uv;           // Metres along the surface.
  float footprint = 0;          // Width of the pixel's patch, metres.
  float incidence = 0;          // Cosine between the line of sight and face_normal.
};

// How much light reaches a point: the visible part (0 to 1) of each lamp, then of the surroundings.
constexpr int kMaxLights = 3;
using Lighting = Eigen::Vector4f;

// `pixel_angle`: radians a pixel covers.
SurfacePoint LocateHit(const Scene& scene, const Hit& hit, const Ray& ray, float pixel_angle);

// Light sent from the point to the viewer (linear BGR): Lambert's law plus Blinn's highlight.
Eigen::Vector3f Shade(const Scene& scene,
                      const SurfacePoint& point,
                      const Eigen::Vector3f& p_world_viewer,
                      const Lighting& lighting);

}  // namespace semslam

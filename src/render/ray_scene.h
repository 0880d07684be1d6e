// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "semslam/render/scene.h"

namespace semslam {

// A ray starts at `origin` and ends after `length` times `direction`.
struct Ray {
  Eigen::Vector3f origin;
  Eigen::Vector3f direction;
  float length;
};

// Where a ray first meets a surface.
struct Hit {
  static constexpr std::uint32_t kNone = 0xffffffffU;
  std::uint32_t part = kNone;  // Index into Scene::parts, kNone: nothing hit.
  std::uint32_t triangle = 0;
  float u = 0;  // Barycentric weights of the triangle's second and third corner.
  float v = 0;
  float distance = 0;  // In lengths of the direction.
};

// The scene in a form for fast ray casting (Embree). Safe to use from several threads.
class RayScene {
 public:
  explicit RayScene(const Scene& scene);
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;
  ~RayScene();

  // Rays that lie close together are fast. `hits` is as long as `rays`.
  void Intersect(std::span<const Ray> rays, std::span<Hit> hits) const;
  // 1 where something is in the ray's way, else 0.
  void Occluded(std::span<const Ray> rays, std::span<std::uint8_t> occluded) const;

 private:
  class Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace semslam

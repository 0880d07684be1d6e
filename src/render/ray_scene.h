// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "semslam/render/scene.h"

#include "render/lanes.h"

namespace semslam {

// Rays side by side. A ray starts at `origin` and ends after `length` times `direction`; one with a
// negative length is not cast.
struct RayBatch {
  void Resize(std::size_t size);
  std::size_t size() const { return num_rays; }

  VectorRow origin;
  VectorRow direction;
  FloatRow length;
  // If not 0, the batch holds two rows of so many rays (a multiple of 4), of neighbouring pixels in
  // both directions.
  std::size_t row_length = 0;
  // Neighbours go nearly the same way, which makes them faster. Only a hint.
  bool is_coherent = true;
  std::size_t num_rays = 0;  // As resized to.
};

struct Hit {
  static constexpr std::uint32_t kNone = 0xffffffffU;
};

// Where each ray of a batch first meets a surface.
struct HitBatch {
  std::vector<std::uint32_t> part;      // Index into Scene::parts, Hit::kNone: nothing hit.
  std::vector<std::uint32_t> triangle;  // Of the part's mesh.
  FloatRow u;  // Barycentric weights of the triangle's second and third corner.
  FloatRow v;
  FloatRow distance;  // In lengths of the direction; 0 if nothing is hit.
};

// The scene in a form for fast ray casting (Embree). Safe to use from several threads.
class RayScene {
 public:
  // kTight: no ray ever slips through between two triangles that share an edge. kFast: one in some
  // millions does, which a mean of rays does not show; takes two thirds of the time.
  enum class Edges { kTight, kFast };

  RayScene(const Scene& scene, Edges edges);
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;
  ~RayScene();

  void Intersect(const RayBatch& rays, HitBatch* hits) const;
  // 0 where something is in the ray's way or the ray is not cast, else 1.
  void Visibility(const RayBatch& rays, FloatRow* visible) const;

 private:
  class Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace semslam

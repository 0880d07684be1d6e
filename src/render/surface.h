// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "semslam/render/scene.h"

#include "render/lanes.h"
#include "render/ray_scene.h"

namespace semslam {

// Points where lines of sight meet the scene, one array a quantity, so that four are computed at a
// time. Where nothing is met, `part` is Hit::kNone and all else is 0.
struct SurfacePoints {
  std::vector<std::uint32_t> part;  // Index into Scene::parts.
  VectorRow p_world;
  VectorRow face_normal;  // Of the triangle, towards the viewer.
  VectorRow normal;       // For shading: interpolated, towards the viewer.
  FloatRow u;             // Metres along the surface.
  FloatRow v;
  FloatRow footprint;  // Width of the pixel's patch, metres.
  FloatRow incidence;  // Cosine between the line of sight and face_normal.

  // The size must be a multiple of 4.
  void Resize(std::size_t size);
};

// What of the scene's triangles is looked up in every pixel, made ready beforehand.
class TriangleTable {
 public:
  explicit TriangleTable(const Scene& scene);

  // Writes the points that the rays (a multiple of 4 of them) hit to `points`, from index `first`
  // on.
  // `pixel_angle`: radians a pixel covers.
  void Locate(const RayBatch& rays,
              const HitBatch& hits,
              float pixel_angle,
              std::size_t first,
              SurfacePoints* points) const;

 private:
  struct Triangle {
    Eigen::Vector3f face_normal;
    bool is_flat;  // All three normals are the face's.
    std::array<Eigen::Vector3f, 3> normals;
    std::array<Eigen::Vector2f, 3> uvs;
  };

  static void Interpolate(
      const Triangle& triangle, float u, float v, std::size_t index, SurfacePoints* points);

  std::vector<std::size_t> first_of_part_;
  std::vector<Triangle> triangles_;
};

}  // namespace semslam

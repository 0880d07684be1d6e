// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/surface.h"

#include <algorithm>

#include "semslam/base/check.h"

namespace semslam {
namespace {

constexpr float kMinCosine = 0.05F;

void SetPoint(VectorRow& row, std::size_t index, const Eigen::Vector3f& value) {
  row.x[index] = value.x();
  row.y[index] = value.y();
  row.z[index] = value.z();
}

// Fills in what depends on the line of sight, for four points.
void PlaceOnRays(const Vector4& origin,
                 const Vector4& direction,
                 Float4 distance,
                 float pixel_angle,
                 std::size_t index,
                 SurfacePoints* points) {
  const Float4 ray_norm = Sqrt(Dot(direction, direction));
  const Vector4 face_normal = points->face_normal.At(index);
  const Float4 cosine = Float4(-1.0F) * Dot(face_normal, direction) / ray_norm;
  const Float4 side = SignOf(cosine);  // -1: seen from behind.
  const Float4 incidence = Min(Abs(cosine), 1.0F);
  points->p_world.Set(index, origin + distance * direction);
  points->face_normal.Set(index, side * face_normal);
  points->normal.Set(index, side * points->normal.At(index));
  points->incidence.Set(index, incidence);
  // Between the patch's short and long side, as a texture sample is round and the patch is not.
  // Half a pixel more than the patch: lenses of such cameras are soft.
  points->footprint.Set(
      index, Float4(1.5F * pixel_angle) * distance * ray_norm / Sqrt(Max(incidence, kMinCosine)));
}

}  // namespace

void SurfacePoints::Resize(std::size_t size) {
  part.resize(size + FloatRow::kRoom, Hit::kNone);
  for (VectorRow* row : {&p_world, &face_normal, &normal}) row->Resize(size);
  for (FloatRow* row : {&u, &v, &footprint, &incidence}) row->Resize(size);
}

TriangleTable::TriangleTable(const Scene& scene) {
  for (const ScenePart& part : scene.parts()) {
    first_of_part_.push_back(triangles_.size());
    const TriangleMesh& mesh = part.mesh;
    for (const Eigen::Vector3i& corners : mesh.triangles) {
      const Eigen::Vector3f& a = mesh.positions[corners[0]];
      Triangle triangle;
      triangle.face_normal =
          (mesh.positions[corners[1]] - a).cross(mesh.positions[corners[2]] - a).normalized();
      triangle.is_flat = true;
      for (int k = 0; k < 3; ++k) {
        triangle.normals[k] = mesh.normals[corners[k]];
        triangle.uvs[k] = mesh.uvs[corners[k]];
        triangle.is_flat &= (triangle.normals[k] - triangle.face_normal).norm() < 1e-4F;
      }
      triangles_.push_back(triangle);
    }
  }
}

void TriangleTable::Interpolate(
    const Triangle& triangle, float u, float v, std::size_t index, SurfacePoints* points) {
  const float w = 1.0F - u - v;
  SetPoint(points->face_normal, index, triangle.face_normal);
  if (triangle.is_flat) {
    SetPoint(points->normal, index, triangle.face_normal);
  } else {
    const Eigen::Vector3f sum =
        w * triangle.normals[0] + u * triangle.normals[1] + v * triangle.normals[2];
    SetPoint(points->normal, index, sum.normalized());
  }
  const Eigen::Vector2f uv = w * triangle.uvs[0] + u * triangle.uvs[1] + v * triangle.uvs[2];
  points->u[index] = uv.x();
  points->v[index] = uv.y();
}

void TriangleTable::Locate(const RayBatch& rays,
                           const HitBatch& hits,
                           float pixel_angle,
                           std::size_t first,
                           SurfacePoints* points) const {
  SEMSLAM_CHECK(rays.size() % 4 == 0);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const std::uint32_t part = hits.part[i];
    points->part[first + i] = part;
    if (part == Hit::kNone) {
      SetPoint(points->face_normal, first + i, Eigen::Vector3f::Zero());
      SetPoint(points->normal, first + i, Eigen::Vector3f::Zero());
      points->u[first + i] = points->v[first + i] = 0;
    } else {
      Interpolate(triangles_[first_of_part_[part] + hits.triangle[i]], hits.u[i], hits.v[i],
                  first + i, points);
    }
  }
  for (std::size_t i = 0; i < rays.size(); i += 4) {
    PlaceOnRays(rays.origin.At(i), rays.direction.At(i), hits.distance.At(i), pixel_angle,
                first + i, points);
  }
}

}  // namespace semslam

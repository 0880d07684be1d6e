// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "semslam/base/check.h"

namespace semslam {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// Joins a grid of vertices, row by row from `first`, into triangles. Counter-clockwise where
// (along a row) x (to the next row) points outwards.
void AddGridTriangles(int first, int num_columns, int num_rows, TriangleMesh* mesh) {
  for (int row = 0; row + 1 < num_rows; ++row) {
    for (int column = 0; column + 1 < num_columns; ++column) {
      const int a = first + row * num_columns + column;
      const int c = a + num_columns;
      mesh->triangles.emplace_back(a, a + 1, c + 1);
      mesh->triangles.emplace_back(a, c + 1, c);
    }
  }
}

// Where the grid lines of a rounded face lie: dense in the rounding, none on the flat.
std::vector<float> RoundedSteps(float half, float radius, int num_segments) {
  std::vector<float> steps;
  for (int i = 0; i <= num_segments; ++i) {
    const float angle =
        0.25F * kPi * (1.0F - static_cast<float>(i) / static_cast<float>(num_segments));
    steps.push_back(-half + radius * (1.0F - std::tan(angle)));
  }
  for (int i = num_segments; i >= 0; --i) steps.push_back(-steps[i]);
  return steps;
}

// One of the six sides of a rounded box: `axis` is its normal's, `sign` its side.
void AddRoundedSide(const Eigen::Vector3f& half,
                    float radius,
                    int num_segments,
                    int axis,
                    float sign,
                    TriangleMesh* mesh) {
  const int axis_u = sign > 0 ? (axis + 1) % 3 : (axis + 2) % 3;
  const int axis_v = sign > 0 ? (axis + 2) % 3 : (axis + 1) % 3;
  const std::vector<float> steps_u = RoundedSteps(half[axis_u], radius, num_segments);
  const std::vector<float> steps_v = RoundedSteps(half[axis_v], radius, num_segments);
  const Eigen::Vector3f inner_half = half.array() - radius;
  const int first = static_cast<int>(mesh->positions.size());
  for (const float v : steps_v) {
    for (const float u : steps_u) {
      Eigen::Vector3f on_cube;
      on_cube[axis] = sign * half[axis];
      on_cube[axis_u] = u;
      on_cube[axis_v] = v;
      const Eigen::Vector3f inner = on_cube.cwiseMax(-inner_half).cwiseMin(inner_half);
      const Eigen::Vector3f normal = (on_cube - inner).normalized();
      mesh->positions.push_back(inner + radius * normal);
      mesh->normals.push_back(normal);
      mesh->uvs.emplace_back(u + half[axis_u], v + half[axis_v]);
    }
  }
  AddGridTriangles(first, static_cast<int>(steps_u.size()), static_cast<int>(steps_v.size()), mesh);
}

// Turns the profile points with the given normals (radius, z) around the axis.
void AddRevolution(std::span<const Eigen::Vector2f> profile,
                   std::span<const Eigen::Vector2f> profile_normals,
                   int num_segments,
                   TriangleMesh* mesh) {
  const int first = static_cast<int>(mesh->positions.size());
  float max_radius = 0;
  for (const Eigen::Vector2f& point : profile) max_radius = std::max(max_radius, point.x());
  float arc = 0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (i > 0) arc += (profile[i] - profile[i - 1]).norm();
    for (int k = 0; k <= num_segments; ++k) {
      const float angle = 2.0F * kPi * static_cast<float>(k) / static_cast<float>(num_segments);
      const Eigen::Vector2f side(std::cos(angle), std::sin(angle));
      const Eigen::Vector2f& normal = profile_normals[i];
      mesh->positions.emplace_back(profile[i].x() * side.x(), profile[i].x() * side.y(),
                                   profile[i].y());
      mesh->normals.emplace_back(normal.x() * side.x(), normal.x() * side.y(), normal.y());
      mesh->uvs.emplace_back(angle * max_radius, arc);
    }
  }
  AddGridTriangles(first, num_segments + 1, static_cast<int>(profile.size()), mesh);
}

Eigen::Vector2f OutwardNormal(const Eigen::Vector2f& from, const Eigen::Vector2f& to) {
  const Eigen::Vector2f along = (to - from).normalized();
  return {along.y(), -along.x()};
}

std::vector<Eigen::Vector2f> SmoothNormals(std::span<const Eigen::Vector2f> profile) {
  std::vector<Eigen::Vector2f> normals(profile.size(), Eigen::Vector2f::Zero());
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const Eigen::Vector2f normal = OutwardNormal(profile[i], profile[i + 1]);
    normals[i] += normal;
    normals[i + 1] += normal;
  }
  for (Eigen::Vector2f& normal : normals) normal.normalize();
  return normals;
}

// A unit circle's part from the latitude `low` to the top, as (radius, z).
std::vector<Eigen::Vector2f> ArcProfile(float low, int num_steps) {
  std::vector<Eigen::Vector2f> profile;
  for (int i = 0; i <= num_steps; ++i) {
    const float latitude =
        low + (0.5F * kPi - low) * static_cast<float>(i) / static_cast<float>(num_steps);
    profile.emplace_back(i == num_steps ? 0.0F : std::cos(latitude), std::sin(latitude));
  }
  return profile;
}

void ScaleAxes(const Eigen::Vector3f& scale, TriangleMesh* mesh) {
  const float mean = scale.mean();
  for (Eigen::Vector3f& position : mesh->positions) position = position.cwiseProduct(scale);
  for (Eigen::Vector3f& normal : mesh->normals) normal = normal.cwiseQuotient(scale).normalized();
  for (Eigen::Vector2f& uv : mesh->uvs) uv *= mean;
}

// Frames along a line of points that turn as little as they can: columns (side, up, along).
std::vector<Eigen::Matrix3f> TubeFrames(std::span<const Eigen::Vector3f> points) {
  std::vector<Eigen::Matrix3f> frames;
  const auto num_points = static_cast<std::ptrdiff_t>(points.size());
  Eigen::Vector3f side = Eigen::Vector3f::Zero();
  for (std::ptrdiff_t i = 0; i < num_points; ++i) {
    const Eigen::Vector3f along =
        (points[std::min(i + 1, num_points - 1)] - points[std::max<std::ptrdiff_t>(i - 1, 0)])
            .normalized();
    if (i == 0) {
      side = std::abs(along.z()) < 0.9F ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f::UnitX();
    }
    side = (side - side.dot(along) * along).normalized();
    Eigen::Matrix3f frame;
    frame << side, along.cross(side), along;
    frames.push_back(frame);
  }
  return frames;
}

// One ring of a tube or of its cap: a circle around `center` at `offset` along the tube.
struct Ring {
  std::size_t point;
  float radius;
  float offset;
};

std::vector<Ring> TubeRings(std::size_t num_points, float radius) {
  constexpr int kCapRings = 4;
  std::vector<Ring> rings;
  for (int i = 0; i < kCapRings; ++i) {
    const float angle = 0.5F * kPi * static_cast<float>(i) / kCapRings;
    rings.push_back({0, radius * std::sin(angle), -radius * std::cos(angle)});
  }
  for (std::size_t i = 0; i < num_points; ++i) rings.push_back({i, radius, 0});
  for (int i = kCapRings - 1; i >= 0; --i) {
    const float angle = 0.5F * kPi * static_cast<float>(i) / kCapRings;
    rings.push_back({num_points - 1, radius * std::sin(angle), radius * std::cos(angle)});
  }
  return rings;
}

}  // namespace

void TriangleMesh::Append(const TriangleMesh& other) {
  const int first = static_cast<int>(positions.size());
  positions.insert(positions.end(), other.positions.begin(), other.positions.end());
  normals.insert(normals.end(), other.normals.begin(), other.normals.end());
  uvs.insert(uvs.end(), other.uvs.begin(), other.uvs.end());
  for (const Eigen::Vector3i& triangle : other.triangles) {
    triangles.emplace_back(triangle.array() + first);
  }
}

TriangleMesh MakeRectangle(float width, float height) {
  TriangleMesh mesh;
  for (const float v : {0.0F, height}) {
    for (const float u : {0.0F, width}) {
      mesh.positions.emplace_back(u - 0.5F * width, v - 0.5F * height, 0.0F);
      mesh.normals.emplace_back(Eigen::Vector3f::UnitZ());
      mesh.uvs.emplace_back(u, v);
    }
  }
  AddGridTriangles(0, 2, 2, &mesh);
  return mesh;
}

TriangleMesh MakeBox(const Eigen::Vector3f& size) {
  const Eigen::Vector3f half = 0.5F * size;
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0F, 1.0F}) {
      const int axis_u = sign > 0 ? (axis + 1) % 3 : (axis + 2) % 3;
      const int axis_v = sign > 0 ? (axis + 2) % 3 : (axis + 1) % 3;
      const int first = static_cast<int>(mesh.positions.size());
      for (const float v : {-1.0F, 1.0F}) {
        for (const float u : {-1.0F, 1.0F}) {
          Eigen::Vector3f position;
          position[axis] = sign * half[axis];
          position[axis_u] = u * half[axis_u];
          position[axis_v] = v * half[axis_v];
          mesh.positions.push_back(position);
          mesh.normals.emplace_back(sign * Eigen::Vector3f::Unit(axis));
          mesh.uvs.emplace_back((u + 1) * half[axis_u], (v + 1) * half[axis_v]);
        }
      }
      AddGridTriangles(first, 2, 2, &mesh);
    }
  }
  return mesh;
}

TriangleMesh MakeRoundedBox(const Eigen::Vector3f& size, float radius, int num_segments) {
  const Eigen::Vector3f half = 0.5F * size;
  SEMSLAM_CHECK(radius > 0 && radius <= half.minCoeff() * 1.0001F) << "radius = " << radius;
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    AddRoundedSide(half, radius, num_segments, axis, -1.0F, &mesh);
    AddRoundedSide(half, radius, num_segments, axis, 1.0F, &mesh);
  }
  return mesh;
}

TriangleMesh MakeLathe(std::span<const Eigen::Vector2f> profile, int num_segments, bool smooth) {
  SEMSLAM_CHECK(profile.size() >= 2) << "points: " << profile.size();
  TriangleMesh mesh;
  if (smooth) {
    AddRevolution(profile, SmoothNormals(profile), num_segments, &mesh);
    return mesh;
  }
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const Eigen::Vector2f normal = OutwardNormal(profile[i], profile[i + 1]);
    const std::vector<Eigen::Vector2f> normals = {normal, normal};
    AddRevolution(profile.subspan(i, 2), normals, num_segments, &mesh);
  }
  return mesh;
}

TriangleMesh MakeCylinder(float radius, float height, int num_segments) {
  const std::vector<Eigen::Vector2f> profile = {{0, 0}, {radius, 0}, {radius, height}, {0, height}};
  return MakeLathe(profile, num_segments, false);
}

TriangleMesh MakeEllipsoid(const Eigen::Vector3f& radii, int num_segments) {
  std::vector<Eigen::Vector2f> profile = ArcProfile(-0.5F * kPi, num_segments / 2);
  profile.front().x() = 0;
  TriangleMesh mesh;
  AddRevolution(profile, profile, num_segments, &mesh);  // A unit sphere's normals are its points.
  ScaleAxes(radii, &mesh);
  return mesh;
}

TriangleMesh MakeDome(const Eigen::Vector3f& radii, int num_segments) {
  const std::vector<Eigen::Vector2f> arc = ArcProfile(0, num_segments / 4);
  const std::vector<Eigen::Vector2f> disc = {{0, 0}, {1, 0}};
  TriangleMesh mesh;
  AddRevolution(arc, arc, num_segments, &mesh);
  mesh.Append(MakeLathe(disc, num_segments, false));
  ScaleAxes(radii, &mesh);
  return mesh;
}

TriangleMesh MakeTube(std::span<const Eigen::Vector3f> points, float radius, int num_segments) {
  SEMSLAM_CHECK(points.size() >= 2) << "points: " << points.size();
  const std::vector<Eigen::Matrix3f> frames = TubeFrames(points);
  const std::vector<Ring> rings = TubeRings(points.size(), radius);
  TriangleMesh mesh;
  float arc = 0;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const Ring& ring = rings[i];
    const Eigen::Matrix3f& frame = frames[ring.point];
    const Eigen::Vector3f center = points[ring.point] + ring.offset * frame.col(2);
    if (i > 0) {
      const Ring& before = rings[i - 1];
      arc += (center - points[before.point] - before.offset * frames[before.point].col(2)).norm();
    }
    for (int k = 0; k <= num_segments; ++k) {
      const float angle = 2.0F * kPi * static_cast<float>(k) / static_cast<float>(num_segments);
      const Eigen::Vector3f side = frame.col(0) * std::cos(angle) + frame.col(1) * std::sin(angle);
      const Eigen::Vector3f normal = (ring.radius * side + ring.offset * frame.col(2)) / radius;
      mesh.positions.push_back(center + ring.radius * side);
      mesh.normals.push_back(normal);
      mesh.uvs.emplace_back(angle * radius, arc);
    }
  }
  AddGridTriangles(0, num_segments + 1, static_cast<int>(rings.size()), &mesh);
  return mesh;
}

TriangleMesh Transformed(TriangleMesh mesh, const Rigid3& T_target_mesh) {
  const Eigen::Matrix3f rotation = T_target_mesh.rotation.cast<float>().toRotationMatrix();
  const Eigen::Vector3f translation = T_target_mesh.translation.cast<float>();
  for (Eigen::Vector3f& position : mesh.positions) position = rotation * position + translation;
  for (Eigen::Vector3f& normal : mesh.normals) normal = rotation * normal;
  return mesh;
}

TriangleMesh Translated(TriangleMesh mesh, const Eigen::Vector3f& offset) {
  for (Eigen::Vector3f& position : mesh.positions) position += offset;
  return mesh;
}

TriangleMesh WithPlanarUv(TriangleMesh mesh, const Eigen::Vector2f& origin) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    mesh.uvs[i] = mesh.positions[i].head<2>() - origin;
  }
  return mesh;
}

}  // namespace semslam

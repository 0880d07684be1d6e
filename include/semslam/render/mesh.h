// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "semslam/geometry/rigid3.h"

namespace semslam {

// A triangle mesh with a normal (for shading) and a surface coordinate (metres along the surface)
// per vertex. Triangles are counter-clockwise seen from outside.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;
  std::vector<Eigen::Vector2f> uvs;
  std::vector<Eigen::Vector3i> triangles;

  void Append(const TriangleMesh& other);
};

// Shapes around the origin, z up unless said otherwise. Sizes and radii in metres.

// Rectangle in the plane z = 0 that looks along +z; uv starts at its (-x, -y) corner.
TriangleMesh MakeRectangle(float width, float height);
TriangleMesh MakeBox(const Eigen::Vector3f& size);
// A box whose edges and corners are rounded; `radius` is at most half the shortest side.
TriangleMesh MakeRoundedBox(const Eigen::Vector3f& size, float radius, int num_segments = 3);
// Turns a profile of (radius, z) around the z axis. Seen with the axis on the left, the profile
// runs upwards on an outer face. Smooth: one shading normal per profile point; else every segment
// is flat.
TriangleMesh MakeLathe(std::span<const Eigen::Vector2f> profile, int num_segments, bool smooth);
// Closed cylinder from z = 0 to `height`.
TriangleMesh MakeCylinder(float radius, float height, int num_segments = 32);
TriangleMesh MakeEllipsoid(const Eigen::Vector3f& radii, int num_segments = 32);
// The upper half of an ellipsoid, closed by a disc at z = 0.
TriangleMesh MakeDome(const Eigen::Vector3f& radii, int num_segments = 32);
// A round tube along a line of points, its ends closed by half spheres: a capsule if there are two.
TriangleMesh MakeTube(std::span<const Eigen::Vector3f> points, float radius, int num_segments = 12);

TriangleMesh Transformed(TriangleMesh mesh, const Rigid3& T_target_mesh);
// Moves without turning.
TriangleMesh Translated(TriangleMesh mesh, const Eigen::Vector3f& offset);
// Replaces the surface coordinates by (x - origin.x, y - origin.y): a picture laid on from above.
TriangleMesh WithPlanarUv(TriangleMesh mesh, const Eigen::Vector2f& origin);

}  // namespace semslam

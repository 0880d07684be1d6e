// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/mesh.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace semslam {
namespace {

constexpr double kPi = std::numbers::pi;

// By the divergence theorem; positive only if the faces of a closed mesh look outwards.
double Volume(const TriangleMesh& mesh) {
  double volume = 0;
  for (const Eigen::Vector3i& corners : mesh.triangles) {
    const Eigen::Vector3d a = mesh.positions[corners[0]].cast<double>();
    const Eigen::Vector3d b = mesh.positions[corners[1]].cast<double>();
    const Eigen::Vector3d c = mesh.positions[corners[2]].cast<double>();
    volume += a.cross(b).dot(c) / 6.0;
  }
  return volume;
}

// Smallest cosine between a triangle's own normal and those of its corners.
double WorstNormalCosine(const TriangleMesh& mesh) {
  double worst = 1;
  for (const Eigen::Vector3i& corners : mesh.triangles) {
    const Eigen::Vector3f& a = mesh.positions[corners[0]];
    const Eigen::Vector3f normal =
        (mesh.positions[corners[1]] - a).cross(mesh.positions[corners[2]] - a);
    if (normal.norm() < 1e-12F) continue;  // The poles of a lathe.
    for (int k = 0; k < 3; ++k) {
      worst =
          std::min(worst, static_cast<double>(normal.normalized().dot(mesh.normals[corners[k]])));
    }
  }
  return worst;
}

TEST(Mesh, BoxEnclosesItsVolume) { EXPECT_NEAR(Volume(MakeBox({0.2F, 0.3F, 0.5F})), 0.03, 1e-7); }

TEST(Mesh, RoundedBoxEnclosesBoxPlusRims) {
  // Steiner's formula for the inner box: volume + surface r + mean width terms r^2 + ball.
  const double r = 0.05;
  const Eigen::Vector3d inner(0.1, 0.2, 0.4);
  const double expected =
      inner.prod() +
      2 * r * (inner.x() * inner.y() + inner.y() * inner.z() + inner.z() * inner.x()) +
      kPi * r * r * inner.sum() + 4.0 / 3.0 * kPi * r * r * r;
  EXPECT_NEAR(Volume(MakeRoundedBox({0.2F, 0.3F, 0.5F}, 0.05F, 12)), expected, 0.002 * expected);
}

TEST(Mesh, CylinderEnclosesItsVolume) {
  const double expected = kPi * 0.01 * 0.3;
  EXPECT_NEAR(Volume(MakeCylinder(0.1F, 0.3F, 256)), expected, 0.001 * expected);
}

TEST(Mesh, EllipsoidEnclosesItsVolume) {
  const double expected = 4.0 / 3.0 * kPi * 0.1 * 0.2 * 0.3;
  EXPECT_NEAR(Volume(MakeEllipsoid({0.1F, 0.2F, 0.3F}, 256)), expected, 0.001 * expected);
}

TEST(Mesh, DomeEnclosesHalfAnEllipsoid) {
  const double expected = 2.0 / 3.0 * kPi * 0.1 * 0.2 * 0.3;
  EXPECT_NEAR(Volume(MakeDome({0.1F, 0.2F, 0.3F}, 256)), expected, 0.001 * expected);
}

TEST(Mesh, TubeOfTwoPointsIsACapsule) {
  const std::vector<Eigen::Vector3f> line = {{0, 0, 0}, {0.3F, 0.4F, 0}};
  const double expected = kPi * 0.01 * 0.5 + 4.0 / 3.0 * kPi * 0.001;
  EXPECT_NEAR(Volume(MakeTube(line, 0.1F, 128)), expected, 0.02 * expected);  // Caps of four rings.
}

TEST(Mesh, ShadingNormalsFollowTheFaces) {
  const std::vector<Eigen::Vector3f> line = {{0, 0, 0}, {0.3F, 0.1F, 0}, {0.5F, 0.4F, 0.1F}};
  EXPECT_GT(WorstNormalCosine(MakeBox({1, 2, 3})), 0.9999);
  EXPECT_GT(WorstNormalCosine(MakeRoundedBox({1, 2, 3}, 0.3F, 6)), 0.95);
  EXPECT_GT(WorstNormalCosine(MakeEllipsoid({1, 2, 3}, 64)), 0.95);
  EXPECT_GT(WorstNormalCosine(MakeTube(line, 0.02F)), 0.7);
}

TEST(Mesh, TransformedMovesPositionsAndTurnsNormals) {
  const Rigid3 T_target_mesh{ExpSO3({0, 0, kPi / 2}), {1, 2, 3}};
  const TriangleMesh mesh = MakeRoundedBox({0.2F, 0.3F, 0.5F}, 0.05F);
  const TriangleMesh moved = Transformed(mesh, T_target_mesh);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Eigen::Vector3d expected = T_target_mesh * mesh.positions[i].cast<double>();
    ASSERT_LT((moved.positions[i].cast<double>() - expected).norm(), 1e-6);
    const Eigen::Vector3d normal = T_target_mesh.rotation * mesh.normals[i].cast<double>();
    ASSERT_LT((moved.normals[i].cast<double>() - normal).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace semslam

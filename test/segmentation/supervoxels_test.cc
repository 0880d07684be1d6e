// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/supervoxels.h"

#include <map>
#include <set>

#include <gtest/gtest.h>

#include "segmentation/disjoint_sets.h"
#include "segmentation/patches.h"
#include "segmentation/synthetic_scene.h"
#include "segmentation/voxel_normals.h"

namespace semslam {
namespace {

struct Grown {
  VoxelGrid grid;
  std::vector<Eigen::Vector3f> normals;
  Supervoxels supervoxels;
};

Grown Grow(const PointCloudView& cloud) {
  Grown result;
  result.grid = BuildVoxelGrid(cloud, 0.008, 1);
  result.normals = ComputeVoxelNormals(result.grid, 1);
  result.supervoxels = GrowSupervoxels(result.grid, result.normals, SupervoxelOptions(), 1);
  return result;
}

TEST(VoxelNormals, AreThoseOfTheSurfaceOnTheViewersSide) {
  test::SyntheticScene scene;
  scene.AddRectangle({0, 0, 0}, {0.3, 0, 0.1}, {0, 0.3, 0.05}, 1);
  const Eigen::Vector3f expected = scene.normals[0];
  for (const bool is_flipped : {false, true}) {
    const float sign = is_flipped ? -1.0F : 1.0F;
    for (Eigen::Vector3f& normal : scene.normals) normal = 3.0F * sign * expected;
    const VoxelGrid grid = BuildVoxelGrid(scene.View(), 0.008, 1);
    for (const Eigen::Vector3f& normal : ComputeVoxelNormals(grid, 2)) {
      ASSERT_GT(normal.dot(sign * expected), 0.999F);
    }
  }
}

TEST(VoxelNormals, OfUnknownSideAreTurnedAlike) {
  test::SyntheticScene scene;
  scene.AddSphere({0, 0, 0}, 0.1, 1);
  const VoxelGrid grid = BuildVoxelGrid({scene.points, {}}, 0.008, 1);
  const auto normals = ComputeVoxelNormals(grid, 1);
  std::size_t num_outwards = 0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Eigen::Vector3d p = grid.origin + grid.centroids[i].cast<double>();
    num_outwards += normals[i].cast<double>().dot(p) > 0 ? 1 : 0;
  }
  EXPECT_TRUE(num_outwards == 0 || num_outwards == grid.size()) << num_outwards;
}

TEST(Supervoxels, AreConnected) {
  const test::SyntheticScene scene = test::MakeDesk(0.002);
  const Grown grown = Grow(scene.View());
  DisjointSets sets(grown.grid.size());
  for (std::uint32_t a = 0; a < grown.grid.size(); ++a) {
    for (const std::uint32_t b : grown.grid.NeighboursOf(a)) {
      if (grown.supervoxels.patch_of_voxel[a] == grown.supervoxels.patch_of_voxel[b]) {
        sets.Join(a, b);
      }
    }
  }
  std::map<std::uint32_t, std::set<std::uint32_t>> pieces;
  for (std::uint32_t i = 0; i < grown.grid.size(); ++i) {
    const std::uint32_t patch = grown.supervoxels.patch_of_voxel[i];
    if (patch != kNoPatch) pieces[patch].insert(sets.Find(i));
  }
  EXPECT_EQ(pieces.size(), grown.supervoxels.num_patches);
  for (const auto& [patch, roots] : pieces) ASSERT_EQ(roots.size(), 1U) << "patch " << patch;
}

TEST(Supervoxels, NeverCrossAGap) {
  test::SyntheticScene scene;
  scene.AddRectangle({0, 0, 0}, {0.4, 0, 0}, {0, 0.4, 0}, 1);
  scene.AddRectangle({0, 0, 0.025}, {0.4, 0, 0}, {0, 0.4, 0}, 2);
  const Grown grown = Grow(scene.View());
  std::map<std::uint32_t, std::set<std::uint32_t>> owners;
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    owners[grown.supervoxels.patch_of_voxel[grown.grid.voxel_of_point[i]]].insert(scene.truth[i]);
  }
  for (const auto& [patch, found] : owners) EXPECT_EQ(found.size(), 1U) << "patch " << patch;
}

TEST(Supervoxels, KeepToOneSideOfASharpEdge) {
  test::SyntheticScene scene;
  scene.AddRectangle({0, 0, 0}, {0.4, 0, 0}, {0, 0.4, 0}, 1);
  scene.AddRectangle({0, 0.4, 0}, {0.4, 0, 0}, {0, 0, 0.4}, 2);
  const Grown grown = Grow(scene.View());
  std::map<std::uint32_t, std::map<std::uint32_t, std::size_t>> owners;
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    ++owners[grown.supervoxels.patch_of_voxel[grown.grid.voxel_of_point[i]]][scene.truth[i]];
  }
  std::size_t num_wrong = 0;
  for (auto& [patch, counts] : owners) num_wrong += std::min(counts[1], counts[2]);
  EXPECT_LT(static_cast<double>(num_wrong), 0.03 * static_cast<double>(scene.points.size()));
}

TEST(Supervoxels, CrumbsStayWithoutAPatch) {
  test::SyntheticScene scene;
  scene.AddRectangle({0, 0, 0}, {0.4, 0, 0}, {0, 0.4, 0}, 1);
  scene.Add({0.2, 0.2, 0.3}, Eigen::Vector3d::UnitZ(), 2);
  const Grown grown = Grow(scene.View());
  EXPECT_EQ(grown.supervoxels.patch_of_voxel[grown.grid.voxel_of_point.back()], kNoPatch);
}

// Surfaces in eight directions, with and without noise of a voxel's thickness.
TEST(PatchGraph, AreasAddUpToThatOfTheSurface) {
  for (int i = 0; i < 8; ++i) {
    const double noise = i % 2 == 0 ? 0.0 : 0.004;
    const Eigen::Vector3d a = 0.5 * Eigen::Vector3d(1, 0.2 * i, 0.1 * i).normalized();
    const Eigen::Vector3d b = 0.5 * a.cross(Eigen::Vector3d(0.3 * i, -0.1 * i, 1)).normalized();
    test::SyntheticScene scene;
    scene.AddRectangle({0, 0, 0}, a, b, 1, 0.002, noise);
    const Grown grown = Grow(scene.View());
    const PatchGraph graph = BuildPatchGraph(grown.grid, grown.normals, grown.supervoxels, 2);
    double area = 0;
    for (const Patch& patch : graph.patches) area += patch.area;
    EXPECT_NEAR(area, 0.25, 0.25 * 0.12) << "direction " << i << " noise " << noise;
  }
}

TEST(PatchGraph, EdgesJoinThePatchesOfAdjacentVoxels) {
  const test::SyntheticScene scene = test::MakeDesk();
  const Grown grown = Grow(scene.View());
  const PatchGraph graph = BuildPatchGraph(grown.grid, grown.normals, grown.supervoxels, 1);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> expected;
  for (std::uint32_t v = 0; v < grown.grid.size(); ++v) {
    for (const std::uint32_t w : grown.grid.NeighboursOf(v)) {
      const std::uint32_t a = grown.supervoxels.patch_of_voxel[v];
      const std::uint32_t b = grown.supervoxels.patch_of_voxel[w];
      if (v < w && a != b && a != kNoPatch && b != kNoPatch) ++expected[std::minmax(a, b)];
    }
  }
  ASSERT_EQ(graph.edges.size(), expected.size());
  auto next = expected.begin();
  for (const PatchEdge& edge : graph.edges) {
    ASSERT_EQ(std::pair(edge.a, edge.b), next->first);
    ASSERT_EQ(edge.num_contacts, next->second);
    ++next;
  }
}

// A quarter of the patches lose voxels to a neighbour or to a new patch.
TEST(PatchGraph, UpdatedForSomePatchesIsThatBuiltAnew) {
  const test::SyntheticScene scene = test::MakeDesk();
  const Grown grown = Grow(scene.View());
  const PatchGraph before = BuildPatchGraph(grown.grid, grown.normals, grown.supervoxels, 1);
  Supervoxels cut = grown.supervoxels;
  for (const PatchEdge& edge : before.edges) {
    if (edge.a % 8 != 0) continue;
    const bool is_new = edge.a % 16 == 0;
    const std::uint32_t to = is_new ? cut.num_patches++ : edge.b;
    std::size_t i = 0;
    for (std::uint32_t& patch : cut.patch_of_voxel) {
      if (patch == edge.a && ++i % 3 == 0) patch = to;
    }
  }
  std::vector<std::uint32_t> old_number(cut.num_patches, kNoPatch);
  for (std::uint32_t i = 0; i < grown.supervoxels.num_patches; ++i) old_number[i] = i;
  for (std::size_t voxel = 0; voxel < cut.patch_of_voxel.size(); ++voxel) {
    const std::uint32_t from = grown.supervoxels.patch_of_voxel[voxel];
    const std::uint32_t to = cut.patch_of_voxel[voxel];
    if (from != to) old_number[from] = old_number[to] = kNoPatch;
  }
  const PatchGraph expected = BuildPatchGraph(grown.grid, grown.normals, cut, 1);
  const PatchGraph updated =
      UpdatePatchGraph(grown.grid, grown.normals, cut, before, old_number, 2);
  ASSERT_EQ(updated.patches.size(), expected.patches.size());
  for (std::size_t i = 0; i < expected.patches.size(); ++i) {
    ASSERT_EQ(updated.patches[i].centroid, expected.patches[i].centroid);
    ASSERT_EQ(updated.patches[i].normal, expected.patches[i].normal);
    ASSERT_EQ(updated.patches[i].area, expected.patches[i].area);
    ASSERT_EQ(updated.patches[i].variation, expected.patches[i].variation);
  }
  ASSERT_EQ(updated.edges.size(), expected.edges.size());
  for (std::size_t i = 0; i < expected.edges.size(); ++i) {
    ASSERT_EQ(updated.edges[i].a, expected.edges[i].a);
    ASSERT_EQ(updated.edges[i].b, expected.edges[i].b);
    ASSERT_EQ(updated.edges[i].num_contacts, expected.edges[i].num_contacts);
  }
}

}  // namespace
}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/components.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "segmentation/surface_growth.h"

namespace semslam {
namespace {

Patch MakePatch(const Eigen::Vector3d& centroid,
                const Eigen::Vector3d& normal,
                double area = 0.0064) {
  Patch patch;
  patch.centroid = centroid;
  patch.normal = normal.normalized();
  patch.area = area;
  return patch;
}

// Two patches of a roof (angle > 0) or a valley (angle < 0) that meet at x = 0.
std::pair<Patch, Patch> Bend(double degrees) {
  const double slope = 0.5 * degrees * std::numbers::pi / 180;
  const double x = 0.04 * std::cos(slope);
  const double z = -0.04 * std::sin(slope);
  return {MakePatch({-x, 0, z}, {-std::sin(slope), 0, std::cos(slope)}),
          MakePatch({x, 0, z}, {std::sin(slope), 0, std::cos(slope)})};
}

// A row of patches with edges between neighbours.
PatchGraph Row(const std::vector<Patch>& patches) {
  PatchGraph graph;
  graph.patches = patches;
  for (std::uint32_t i = 1; i < patches.size(); ++i) graph.edges.push_back({i - 1, i, 10});
  return graph;
}

TEST(Components, RoofsAreConvexAndValleysAreNot) {
  for (const double degrees : {20.0, 45.0, 90.0, 120.0}) {
    const auto [a, b] = Bend(degrees);
    EXPECT_TRUE(IsConvex(a, b, ComponentOptions())) << degrees;
    const auto [c, d] = Bend(-degrees);
    EXPECT_FALSE(IsConvex(c, d, ComponentOptions())) << degrees;
  }
}

TEST(Components, SlightValleysCountAsFlat) {
  const auto [a, b] = Bend(-8);
  EXPECT_TRUE(IsConvex(a, b, ComponentOptions()));
}

TEST(Components, StepsAreNotConvex) {
  EXPECT_FALSE(IsConvex(MakePatch({0, 0, 0}, {0, 0, 1}), MakePatch({0.08, 0, 0.02}, {0, 0, 1}),
                        ComponentOptions()));
}

TEST(Components, ContactsAlongTheLineOfIntersectionAreNotConvex) {
  // The tangent planes meet in a line along y, and so do the centroids.
  const Patch a = MakePatch({0, 0, 0}, {-1, 0, 1});
  const Patch b = MakePatch({0.002, 0.08, 0}, {1, 0, 1});
  EXPECT_FALSE(IsConvex(a, b, ComponentOptions()));
}

TEST(Components, CrumbsAreUnassigned) {
  const auto flat = [](double x) { return MakePatch({x, 0, 0}, {0, 0, 1}, 0.001); };
  PatchGraph graph = Row({flat(0), flat(0.08)});
  graph.patches.push_back(flat(1));
  const Components components = FindComponents(graph, {0, 0, 0}, ComponentOptions());
  EXPECT_EQ(components.components.size(), 1U);
  EXPECT_EQ(components.component_of_patch[2], kNoComponent);
}

// Four large patches of a floor, then four of a wall: over a convex and over a concave edge.
PatchGraph FloorAndWall(double wall_sign, double area) {
  std::vector<Patch> patches;
  for (int i = 3; i >= 0; --i) {
    patches.push_back(MakePatch({-0.04 - 0.08 * i, 0, 0}, {0, 0, 1}, area));
  }
  for (int i = 0; i < 4; ++i) {
    patches.push_back(MakePatch({0, 0, wall_sign * (0.04 + 0.08 * i)}, {-wall_sign, 0, 0}, area));
  }
  return Row(patches);
}

const std::vector<std::uint32_t> kTwoPlanes = {1, 1, 1, 1, 2, 2, 2, 2};

TEST(Components, SmallFacesJoinOverAConvexEdge) {
  const Components components =
      FindComponents(FloorAndWall(-1, 0.0064), kTwoPlanes, ComponentOptions());
  ASSERT_EQ(components.components.size(), 1U);
  EXPECT_EQ(components.components[0].plane_label, 0U);
  EXPECT_FALSE(components.components[0].is_structural);
}

TEST(Components, SmallFacesStayApartAtAConcaveEdge) {
  const Components components =
      FindComponents(FloorAndWall(1, 0.0064), kTwoPlanes, ComponentOptions());
  ASSERT_EQ(components.components.size(), 2U);
  EXPECT_EQ(components.components[1].plane_label, 2U);
}

TEST(Components, StructuralPlanesStayApartAtAConvexEdge) {
  const Components components =
      FindComponents(FloorAndWall(-1, 0.2), kTwoPlanes, ComponentOptions());
  ASSERT_EQ(components.components.size(), 2U);
  EXPECT_TRUE(components.components[0].is_structural);
  EXPECT_NEAR(components.components[0].area, 0.8, 1e-12);
}

TEST(Components, WarpedFloorOfTwoPlanesIsOne) {
  std::vector<Patch> patches;
  for (int i = 0; i < 8; ++i)
    patches.push_back(MakePatch({0.08 * i, 0, 0.001 * i}, {0, 0, 1}, 0.2));
  const Components components = FindComponents(Row(patches), kTwoPlanes, ComponentOptions());
  ASSERT_EQ(components.components.size(), 1U);
  EXPECT_TRUE(components.components[0].is_structural);
  EXPECT_NE(components.components[0].plane_label, 0U);
}

TEST(Components, AThingOfOnePatchOnATableIsASegment) {
  PatchGraph graph = FloorAndWall(1, 0.2);
  graph.patches.resize(4);
  graph.edges.resize(3);
  graph.patches.push_back(MakePatch({-0.04, 0, 0.03}, {0, 0, 1}, 0.005));
  graph.edges.push_back({3, 4, 10});
  const Components components = FindComponents(graph, {1, 1, 1, 1, 0}, ComponentOptions());
  ASSERT_EQ(components.components.size(), 2U);
  EXPECT_EQ(components.components[1].patches, std::vector<std::uint32_t>{4});
}

TEST(Components, FragmentsJoinTheThingTheyTouchMostAndNoTable) {
  PatchGraph graph;
  for (int i = 0; i < 3; ++i) graph.patches.push_back(MakePatch({0.5 * i, 0, 0}, {0, 0, 1}, 0.3));
  graph.patches.push_back(MakePatch({0.7, 0, 0.1}, {0, 1, 0}, 0.004));
  graph.edges = {{0, 3, 20}, {1, 3, 4}, {2, 3, 5}};
  const Components components = FindComponents(graph, {1, 0, 0, 0}, ComponentOptions());
  EXPECT_EQ(components.component_of_patch, (std::vector<std::uint32_t>{0, 1, 2, 2}));
}

// A table, a body on it of patches that face the given ways, and a head that touches both.
PatchGraph HeadAndBody(std::uint32_t table_contacts,
                       std::uint32_t body_contacts,
                       const std::vector<Eigen::Vector3d>& body_normals) {
  PatchGraph graph;
  graph.patches = {MakePatch({0, 0, 0}, {0, 0, 1}, 0.3),
                   MakePatch({0, 0, 0.35}, {0, -0.5, -1}, 0.03)};
  graph.edges = {{0, 2, 20}, {1, 2, body_contacts}};
  if (table_contacts > 0) graph.edges.insert(graph.edges.begin(), {0, 1, table_contacts});
  for (const Eigen::Vector3d& normal : body_normals) {
    const auto patch = static_cast<std::uint32_t>(graph.patches.size());
    graph.patches.push_back(MakePatch({0, 0, 0.1}, normal, 0.02));
    if (patch > 2) graph.edges.push_back({patch - 1, patch, 10});
  }
  return graph;
}

TEST(Components, WhatRestsOnARoundedThingIsPartOfIt) {
  std::vector<Eigen::Vector3d> rounded;
  std::vector<Eigen::Vector3d> box;
  for (int i = 0; i < 9; ++i) {
    const double angle = 0.7 * i;
    rounded.emplace_back(std::cos(angle), std::sin(angle), 0.3);
    box.emplace_back(Eigen::Vector3d::Unit(i / 3));
  }
  const auto is_joined = [](const PatchGraph& graph) {
    std::vector<std::uint32_t> labels(graph.patches.size(), 2);
    labels[0] = 1;
    labels[1] = 3;
    const Components components = FindComponents(graph, labels, ComponentOptions());
    return components.component_of_patch[1] == components.component_of_patch[2];
  };
  EXPECT_TRUE(is_joined(HeadAndBody(0, 10, rounded)));
  EXPECT_FALSE(is_joined(HeadAndBody(0, 10, box))) << "a thing on a box";
  EXPECT_FALSE(is_joined(HeadAndBody(10, 10, rounded))) << "two things side by side";
}

TEST(Components, AFragmentThatTouchesNothingJoinsWhatIsNear) {
  const auto components_of = [](double distance) {
    PatchGraph graph;
    graph.patches = {MakePatch({0, 0, 0}, {0, 0, 1}, 0.02),
                     MakePatch({0, 0, distance}, {0, 0, 1}, 0.005)};
    return FindComponents(graph, {0, 0}, ComponentOptions()).component_of_patch;
  };
  EXPECT_EQ(components_of(0.02), (std::vector<std::uint32_t>{0, 0}));
  EXPECT_EQ(components_of(0.045), (std::vector<std::uint32_t>{0, 1}));
}

// Two pieces of a wall, `gap` apart.
PatchGraph DividedWall(double gap, double second_area) {
  PatchGraph graph;
  graph.patches = {MakePatch({0, 0, 0}, {0, 0, 1}, 0.2), MakePatch({0.1, 0, 0}, {0, 0, 1}, 0.2),
                   MakePatch({0.1 + gap, 0, 0}, {0, 0, 1}, second_area)};
  graph.edges = {{0, 1, 10}};
  return graph;
}

TEST(Components, WallBehindAMonitorIsOne) {
  const Components components =
      FindComponents(DividedWall(0.6, 0.1), {1, 1, 1}, ComponentOptions());
  ASSERT_EQ(components.components.size(), 1U);
  EXPECT_TRUE(components.components[0].is_structural);
}

TEST(Components, FarAndSmallPiecesOfAPlaneAreNotTheWall) {
  EXPECT_EQ(FindComponents(DividedWall(1.5, 0.1), {1, 1, 1}, ComponentOptions()).components.size(),
            2U);
  EXPECT_EQ(FindComponents(DividedWall(0.6, 0.02), {1, 1, 1}, ComponentOptions()).components.size(),
            2U);
  EXPECT_EQ(FindComponents(DividedWall(0.6, 0.1), {1, 1, 2}, ComponentOptions()).components.size(),
            2U);
}

TEST(Components, ABoxWithAFaceInThePlaneOfTheWallIsNotTheWall) {
  PatchGraph graph = DividedWall(0.6, 0.05);
  graph.patches.push_back(MakePatch({0.75, 0, -0.05}, {1, 0, 0}, 0.05));
  graph.edges.push_back({2, 3, 10});
  const Components components = FindComponents(graph, {1, 1, 1, 2}, ComponentOptions());
  ASSERT_EQ(components.components.size(), 2U);
  EXPECT_FALSE(components.components[1].is_structural);
}

TEST(SurfaceGrowth, FollowsAWarpedPlaneUpToItsTolerance) {
  std::vector<Patch> patches;  // Falls away by 6 mm a patch.
  for (int i = 0; i < 16; ++i) {
    patches.push_back(MakePatch({0.08 * i, 0, -0.006 * std::max(0, i - 3)}, {0, 0, 1}, 0.05));
  }
  std::vector<std::uint32_t> labels(16, 0);
  for (std::size_t i = 0; i < 5; ++i) labels[i] = 1;
  const auto grown =
      GrowSurfaces(Row(patches), {{Eigen::Vector3d::UnitZ(), 0}}, labels, ComponentOptions());
  for (std::size_t i = 0; i < 16; ++i) {
    const bool is_near = patches[i].centroid.z() >= -0.045;
    EXPECT_EQ(grown[i], is_near ? 1U : 0U) << i;
  }
}

TEST(SurfaceGrowth, StopsAtAStep) {
  std::vector<Patch> patches;
  for (int i = 0; i < 8; ++i) {
    patches.push_back(MakePatch({0.08 * i, 0, i < 4 ? 0 : 0.025}, {0, 0, 1}, 0.05));
  }
  const std::vector<std::uint32_t> labels = {1, 1, 1, 1, 0, 0, 0, 0};
  EXPECT_EQ(GrowSurfaces(Row(patches), {{Eigen::Vector3d::UnitZ(), 0}}, labels, ComponentOptions()),
            labels);
}

TEST(SurfaceGrowth, SmallPlanesDoNotGrow) {
  std::vector<Patch> patches;
  for (int i = 0; i < 4; ++i) patches.push_back(MakePatch({0.08 * i, 0, 0}, {0, 0, 1}, 0.01));
  const std::vector<std::uint32_t> labels = {1, 1, 0, 0};
  EXPECT_EQ(GrowSurfaces(Row(patches), {{Eigen::Vector3d::UnitZ(), 0}}, labels, ComponentOptions()),
            labels);
}

}  // namespace
}  // namespace semslam

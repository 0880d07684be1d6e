// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/floating_parts.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace semslam {
namespace {

constexpr double kVoxel = 0.008;  // Metres.

// Patches with their voxels, and what is structural and joined so far.
struct Scene {
  PatchGraph graph;
  std::vector<std::uint32_t> labels;
  std::vector<bool> is_structural;
  std::vector<Eigen::Vector3f> places;
  std::vector<std::uint32_t> patch_of_place;

  void AddPatch(const std::vector<Eigen::Vector3d>& voxels,
                const Eigen::Vector3d& normal,
                std::uint32_t label = 0) {
    Patch patch;
    for (const Eigen::Vector3d& voxel : voxels) {
      patch.moments.Add(voxel);
      places.push_back(voxel.cast<float>());
      patch_of_place.push_back(static_cast<std::uint32_t>(graph.patches.size()));
    }
    patch.centroid = patch.moments.Mean();
    patch.normal = normal;
    patch.num_voxels = voxels.size();
    patch.area = static_cast<double>(voxels.size()) * kVoxel * kVoxel;
    graph.patches.push_back(patch);
    labels.push_back(label);
    is_structural.push_back(false);
  }

  bool Joins(std::uint32_t a, std::uint32_t b, bool with_places = true) const {
    DisjointSets sets(graph.patches.size());
    const PatchPlaces where = with_places ? PatchPlaces{places, patch_of_place} : PatchPlaces{};
    JoinFloatingParts({graph, labels, is_structural, where}, ComponentOptions(), sets);
    return sets.Find(a) == sets.Find(b);
  }
};

// Voxels of a rectangle.
std::vector<Eigen::Vector3d> Sheet(const Eigen::Vector3d& middle,
                                   const Eigen::Vector3d& u,
                                   double width,
                                   const Eigen::Vector3d& v,
                                   double height) {
  std::vector<Eigen::Vector3d> voxels;
  for (double a = 0.5 * (kVoxel - width); a < 0.5 * width; a += kVoxel) {
    for (double b = 0.5 * (kVoxel - height); b < 0.5 * height; b += kVoxel) {
      voxels.emplace_back(middle + a * u + b * v);
    }
  }
  return voxels;
}

// Of an upright cylinder of 4 cm around the origin, from one height and one angle to another.
std::vector<Eigen::Vector3d> Wall(double from, double to, double bottom, double top) {
  std::vector<Eigen::Vector3d> voxels;
  constexpr double kRadius = 0.04;
  for (double angle = from; angle <= to; angle += kVoxel / kRadius) {
    for (double z = bottom; z < top; z += kVoxel) {
      voxels.emplace_back(kRadius * std::cos(angle), kRadius * std::sin(angle), z);
    }
  }
  return voxels;
}

const Eigen::Vector3d kX = Eigen::Vector3d::UnitX();
const Eigen::Vector3d kY = Eigen::Vector3d::UnitY();
const Eigen::Vector3d kZ = Eigen::Vector3d::UnitZ();

// What is seen of a cup from the side of -y: the near outside, and beyond the rim of the far inside
// an arc that does not reach round to it.
Scene Cup() {
  constexpr double kPi = std::numbers::pi;
  Scene scene;
  scene.AddPatch(Wall(-kPi, 0, 0, 0.09), -kY);
  scene.AddPatch(Wall(0.2 * kPi, 0.8 * kPi, 0.06, 0.09), -kY);
  return scene;
}

TEST(FloatingParts, TheFarInsideOfACupIsNearWhereTheCupIsNotWhereItsMiddleIs) {
  EXPECT_TRUE(Cup().Joins(0, 1));
  EXPECT_FALSE(Cup().Joins(0, 1, false)) << "middles are far apart";
}

TEST(FloatingParts, CrumbsThatAreNearestToEachOtherStillJoinTheThing) {
  Scene scene = Cup();
  scene.AddPatch(Sheet({0, 0.055, 0.09}, kX, 2 * kVoxel, kZ, 2 * kVoxel), -kY);
  EXPECT_TRUE(scene.Joins(1, 2));
  EXPECT_TRUE(scene.Joins(0, 1));
}

TEST(FloatingParts, APieceOfTableBesideAThingIsNoPartOfIt) {
  Scene scene = Cup();
  scene.AddPatch(Sheet({0, -0.1, 0}, kX, 0.08, kY, 0.08), kZ, 1);
  EXPECT_TRUE(scene.Joins(1, 2) || scene.Joins(0, 2)) << "as near as a fragment would be";
  scene.AddPatch(Sheet({0.7, 0, 0}, kX, 0.5, kY, 0.8), kZ, 1);
  scene.is_structural[3] = true;
  EXPECT_FALSE(scene.Joins(0, 2));
  EXPECT_FALSE(scene.Joins(1, 2));
  EXPECT_TRUE(scene.Joins(0, 1));
}

// A table (0), a foot that stands on it (1), and a screen (2).
Scene TableWithFoot(const Eigen::Vector3d& screen, double screen_height = 0.3) {
  Scene scene;
  scene.AddPatch(Sheet({0, 0, 0}, kX, 1.0, kY, 0.6), kZ, 1);
  scene.AddPatch(Sheet({0, 0, 0.016}, kX, 0.2, kY, 0.16), kZ, 2);
  scene.AddPatch(Sheet(screen, kX, 0.5, kZ, screen_height), -kY, 3);
  scene.is_structural[0] = true;
  scene.graph.edges = {{0, 1, 60}};
  return scene;
}

TEST(FloatingParts, AScreenStandsOnTheFootBeneathIt) {
  EXPECT_TRUE(TableWithFoot({0, 0, 0.27}).Joins(1, 2));
  EXPECT_TRUE(TableWithFoot({0.05, -0.04, 0.27}).Joins(1, 2)) << "not quite above its middle";
}

TEST(FloatingParts, WhatIsNotBeneathTheCentreCarriesNothing) {
  EXPECT_FALSE(TableWithFoot({0.2, 0, 0.27}).Joins(1, 2)) << "under one side of it";
  EXPECT_FALSE(TableWithFoot({0, 0.15, 0.27}).Joins(1, 2)) << "in front of it";
}

TEST(FloatingParts, AGapLargerThanTheThingIsNotBridged) {
  EXPECT_FALSE(TableWithFoot({0, 0, 0.27}, 0.08).Joins(1, 2));
}

TEST(FloatingParts, WhatTouchesTheTableOrAThingDoesNotFloat) {
  Scene standing = TableWithFoot({0, 0, 0.27});
  standing.graph.edges.push_back({0, 2, 1});
  EXPECT_FALSE(standing.Joins(1, 2)) << "on the table";
  for (const std::uint32_t contacts : {9U, 90U}) {
    Scene leaning = TableWithFoot({0, 0, 0.27});
    leaning.AddPatch(Sheet({0.3, 0, 0.2}, kY, 0.2, kZ, 0.4), kX, 4);
    leaning.graph.edges.push_back({2, 3, contacts});
    EXPECT_EQ(leaning.Joins(1, 2), contacts == 9U) << "at a thing, contacts " << contacts;
  }
}

TEST(FloatingParts, WhatIsAsLargeAsATableIsNoFoot) {
  Scene scene = TableWithFoot({0, 0, 0.27});
  scene.graph.patches[1].area = 0.3;
  EXPECT_FALSE(scene.Joins(1, 2));
}

}  // namespace
}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/relief.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "semslam/segmentation/segmenter.h"

#include "segmentation/local_surface.h"
#include "segmentation/synthetic_scene.h"

namespace semslam {
namespace {

// A table's top as a camera with a bent range image shows it: 15 mm lower in the middle.
double WarpedHeight(double x, double y) {
  const double along = (x - 0.6) / 0.6;
  const double across = (y - 0.4) / 0.4;
  return 0.0075 * (along * along + across * across);
}

// The table (1) with a phone (2) on it, 9 mm high and turned against the voxels.
test::SyntheticScene TableWithPhone(double noise) {
  Random random(3);
  const Eigen::Rotation2Dd turn(-0.4);
  test::SyntheticScene scene;
  for (double x = 0.002; x < 1.2; x += 0.004) {
    for (double y = 0.002; y < 0.8; y += 0.004) {
      const Eigen::Vector2d in_phone = turn * Eigen::Vector2d(x - 0.7, y - 0.3);
      const bool is_phone = std::abs(in_phone.x()) < 0.07 && std::abs(in_phone.y()) < 0.035;
      const double z = WarpedHeight(x, y) + (is_phone ? 0.009 : 0) + noise * random.Gaussian();
      scene.Add({x, y, z}, Eigen::Vector3d::UnitZ(), is_phone ? 2 : 1);
    }
  }
  return scene;
}

// Share of the owner's points in the segment that most of them are in, and its share of others.
std::pair<double, double> FoundAndForeign(const Segmentation& result,
                                          const std::vector<std::uint32_t>& truth,
                                          std::uint32_t owner) {
  std::map<SegmentId, double> own;
  std::map<SegmentId, double> all;
  double num_points = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const SegmentId id = result.segment_of_point[i];
    ++all[id];
    if (truth[i] == owner) ++own[id], ++num_points;
  }
  own.erase(0);
  const auto best = std::max_element(
      own.begin(), own.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return {best->second / num_points, 1 - best->second / all[best->first]};
}

TEST(Relief, APhoneIsApartFromTheWarpedTableItLiesOn) {
  for (const double noise : {0.0, 0.0015}) {
    const test::SyntheticScene scene = TableWithPhone(noise);
    const Segmentation result = Segmenter(Segmenter::Options()).Segment(scene.View());
    for (const std::uint32_t owner : {1U, 2U}) {
      const auto [found, foreign] = FoundAndForeign(result, scene.truth, owner);
      EXPECT_GE(found, 0.93) << "owner " << owner << " noise " << noise;
      EXPECT_LE(foreign, 0.05) << "owner " << owner << " noise " << noise;
    }
  }
}

TEST(Relief, AWarpedAndNoisyTableAloneIsOneSegment) {
  for (const double noise : {0.0, 0.002, 0.004}) {
    test::SyntheticScene scene = TableWithPhone(noise);
    for (std::size_t i = 0; i < scene.points.size(); ++i) {
      if (scene.truth[i] == 2) scene.points[i].z() -= 0.009F;
    }
    const Segmentation result = Segmenter(Segmenter::Options()).Segment(scene.View());
    const auto num_on_table = static_cast<std::size_t>(
        std::count(result.segment_of_point.begin(), result.segment_of_point.end(), 1U));
    EXPECT_GE(static_cast<double>(num_on_table), 0.995 * static_cast<double>(scene.points.size()))
        << "noise " << noise;
  }
}

// A table (1) with a flat dome (2) on it, 12 mm high in the middle and falling to nothing.
test::SyntheticScene TableWithDome(double noise) {
  Random random(5);
  test::SyntheticScene scene;
  for (double x = 0.002; x < 1.2; x += 0.004) {
    for (double y = 0.002; y < 0.8; y += 0.004) {
      const double distance = std::hypot(x - 0.7, y - 0.3) / 0.07;
      const double rise = 0.012 * (1 - distance * distance);
      const double z = std::max(rise, 0.0) + noise * random.Gaussian();
      scene.Add({x, y, z}, Eigen::Vector3d::UnitZ(), rise > 0 ? 2 : 1);
    }
  }
  return scene;
}

TEST(Relief, AFlatDomeKeepsItsRim) {
  for (const double noise : {0.0, 0.0005, 0.001}) {
    const test::SyntheticScene scene = TableWithDome(noise);
    const auto found_with = [&](double min_rim_height) {
      Segmenter::Options options;
      options.relief.min_rim_height = min_rim_height;
      return FoundAndForeign(Segmenter(options).Segment(scene.View()), scene.truth, 2);
    };
    const auto [found, foreign] = found_with(ReliefOptions().min_rim_height);
    EXPECT_GE(found, 0.8) << "noise " << noise;
    EXPECT_LE(foreign, 0.02) << "noise " << noise;
    EXPECT_GE(found, found_with(1.0).first + 0.1) << "the rim makes no difference, noise " << noise;
  }
}

TEST(Relief, NoiseBesideAThingStaysWithTheTable) {
  for (const double noise : {0.0015, 0.003}) {
    const test::SyntheticScene scene = TableWithPhone(noise);
    const auto share_of_table = [&](double max_rim) {
      Segmenter::Options options;
      options.relief.max_rim = max_rim;
      return FoundAndForeign(Segmenter(options).Segment(scene.View()), scene.truth, 1).first;
    };
    EXPECT_GE(share_of_table(1.0), share_of_table(0.0) - 0.002) << "noise " << noise;
  }
}

// Patches of 8 cm on the warped table.
PatchGraph WarpedTable() {
  constexpr std::uint32_t kColumns = 15;
  constexpr std::uint32_t kRows = 10;
  PatchGraph graph;
  for (std::uint32_t i = 0; i < kColumns * kRows; ++i) {
    const double x = 0.08 * (i % kColumns + 0.5);
    const double y = 0.08 * (i / kColumns + 0.5);
    Patch patch;
    patch.centroid = {x, y, WarpedHeight(x, y)};
    patch.normal = Eigen::Vector3d::UnitZ();
    patch.area = 0.0064;
    graph.patches.push_back(patch);
    if (i % kColumns + 1 < kColumns) graph.edges.push_back({i, i + 1, 10});
    if (i + kColumns < kColumns * kRows) graph.edges.push_back({i, i + kColumns, 10});
  }
  return graph;
}

TEST(LocalSurface, FollowsTheWarpAndNotTheThingsOnIt) {
  const PatchGraph table = WarpedTable();
  PatchGraph graph = table;
  for (const std::uint32_t raised : {50U, 51U, 52U, 65U, 66U, 67U}) {  // A keyboard.
    graph.patches[raised].centroid.z() += 0.01;
  }
  const std::vector<std::uint32_t> labels(graph.patches.size(), 1);
  const SurfacePieces pieces =
      FindStructuralPieces(graph, {{-Eigen::Vector3d::UnitZ(), 0.005}}, labels, 0.25);
  ASSERT_EQ(pieces.pieces.size(), 1U);
  EXPECT_GT(pieces.pieces[0].plane.normal.z(), 0.99) << "not towards the viewer";
  const auto surfaces = FindLocalSurfaces(graph, pieces, ReliefOptions(), 1);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    ASSERT_EQ(surfaces[i].size(), 1U);
    EXPECT_NEAR(surfaces[i][0].plane.SignedDistance(table.patches[i].centroid), 0, 0.0025) << i;
  }
}

TEST(LocalSurface, SmallPlanesAreNoPieces) {
  const PatchGraph graph = WarpedTable();
  std::vector<std::uint32_t> labels(graph.patches.size(), 0);
  for (std::uint32_t i = 0; i < 30; ++i) labels[i] = 1;  // 0.19 square metres.
  const SurfacePieces pieces =
      FindStructuralPieces(graph, {{Eigen::Vector3d::UnitZ(), 0}}, labels, 0.25);
  EXPECT_TRUE(pieces.pieces.empty());
  EXPECT_EQ(pieces.piece_of_patch, std::vector<std::uint32_t>(graph.patches.size(), kNoPiece));
}

}  // namespace
}  // namespace semslam

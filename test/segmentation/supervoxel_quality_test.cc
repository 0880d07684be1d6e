// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "semslam/eval/boundary_score.h"
#include "semslam/geometry/rigid3.h"

#include "pcl_methods.h"
#include "segmentation/supervoxels.h"
#include "segmentation/synthetic_scene.h"
#include "segmentation/voxel_normals.h"

namespace semslam {
namespace {

struct Quality {
  std::size_t num_supervoxels = 0;
  double boundary_recall = 0;
  // Share of the points that lie beyond the region which most of their supervoxel is of.
  double under_segmentation = 0;
};

Quality Measure(const test::SyntheticScene& scene, const std::vector<std::uint32_t>& supervoxels) {
  std::map<std::uint32_t, std::map<std::uint32_t, std::size_t>> regions;
  for (std::size_t i = 0; i < supervoxels.size(); ++i) {
    if (supervoxels[i] != 0) ++regions[supervoxels[i]][scene.truth[i]];
  }
  std::size_t num_beyond = 0;
  for (const auto& [supervoxel, counts] : regions) {
    std::size_t most = 0;
    std::size_t sum = 0;
    for (const auto& [region, count] : counts) {
      most = std::max(most, count);
      sum += count;
    }
    num_beyond += sum - most;
  }
  BoundaryOptions boundaries;
  boundaries.tolerance = 0.012;  // One and a half voxels; at 3 cm all boundaries are found.
  return {regions.size(),
          ScoreBoundaries(scene.points, supervoxels, scene.truth, boundaries).recall,
          static_cast<double>(num_beyond) / static_cast<double>(supervoxels.size())};
}

Quality MeasureOurs(const test::SyntheticScene& scene, const SupervoxelOptions& options) {
  const VoxelGrid grid = BuildVoxelGrid(scene.View(), options.voxel_size, 0);
  const Supervoxels found = GrowSupervoxels(grid, ComputeVoxelNormals(grid, 0), options, 0);
  std::vector<std::uint32_t> supervoxels;
  for (const std::uint32_t voxel : grid.voxel_of_point) {
    const std::uint32_t patch = found.patch_of_voxel[voxel];
    supervoxels.push_back(patch == kNoPatch ? 0 : patch + 1);
  }
  return Measure(scene, supervoxels);
}

Quality MeasureThoseOfPcl(const test::SyntheticScene& scene, const SupervoxelOptions& options) {
  PclLccpOptions pcl_options;
  pcl_options.voxel_size = static_cast<float>(options.voxel_size);
  pcl_options.seed_spacing = static_cast<float>(options.seed_spacing);
  pcl_options.spatial_weight = static_cast<float>(options.spatial_weight);
  pcl_options.normal_weight = static_cast<float>(options.normal_weight);
  return Measure(scene, SupervoxelsOfPcl({scene.points, {}}, pcl_options).segment_of_point);
}

// A floor with boxes turned every way and balls standing on it.
test::SyntheticScene MakeHeap(double noise) {
  test::SyntheticScene scene;
  scene.AddRectangle({0, 0, 0}, {1.5, 0, 0}, {0, 1.5, 0}, 1, 0.004, noise, 20);
  std::uint32_t owner = 2;
  for (int i = 0; i < 9; ++i) {
    const Eigen::Vector3d place(0.25 + 0.5 * (i % 3), 0.25 + 0.5 * static_cast<double>(i / 3), 0);
    if (i % 3 == 1) {
      scene.AddSphere(place + Eigen::Vector3d(0, 0, 0.09), 0.09, owner++);
      continue;
    }
    test::SyntheticScene box;
    box.AddBox({-0.1, -0.06, 0.002}, {0.2, 0.12, 0.1}, owner++, noise);
    const Eigen::AngleAxisd turn(0.4 * i, Eigen::Vector3d::UnitZ());
    const test::SyntheticScene placed = box.Transformed(Rigid3(Eigen::Quaterniond(turn), place));
    scene.points.insert(scene.points.end(), placed.points.begin(), placed.points.end());
    scene.normals.insert(scene.normals.end(), placed.normals.begin(), placed.normals.end());
    scene.truth.insert(scene.truth.end(), placed.truth.begin(), placed.truth.end());
  }
  return scene;
}

struct Pair {
  Quality ours;
  Quality of_pcl;
};

// PCL's with the same voxels, seeds and weights, and as ours with normals of its own making: the
// scenes' exact ones are what no camera has.
Pair Compare(const std::string& name, const test::SyntheticScene& scene) {
  const SupervoxelOptions options;
  const Pair pair = {MeasureOurs(scene, options), MeasureThoseOfPcl(scene, options)};
  std::printf("%-12s ours %4zu recall %.3f error %.4f   PCL %4zu recall %.3f error %.4f\n",
              name.c_str(), pair.ours.num_supervoxels, pair.ours.boundary_recall,
              pair.ours.under_segmentation, pair.of_pcl.num_supervoxels,
              pair.of_pcl.boundary_recall, pair.of_pcl.under_segmentation);
  return pair;
}

// Along the voxels and turned against them, exact and as noisy as a map.
class SupervoxelQuality : public ::testing::Test {
 protected:
  static const std::vector<Pair>& Pairs() {
    static const std::vector<Pair> pairs = [] {
      const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
      const Rigid3 T(turn, {1, 2, 3});
      return std::vector<Pair>{
          Compare("desk", test::MakeDesk()), Compare("noisy desk", test::MakeDesk(0.0015)),
          Compare("turned desk", test::MakeDesk(0.0015).Transformed(T)),
          Compare("heap", MakeHeap(0)), Compare("turned heap", MakeHeap(0.0015).Transformed(T))};
    }();
    return pairs;
  }
};

TEST_F(SupervoxelQuality, BoundariesAreFoundAsOftenAsByThoseOfPcl) {
  double ours = 0;
  double of_pcl = 0;
  for (const Pair& pair : Pairs()) {
    EXPECT_GE(pair.ours.boundary_recall, pair.of_pcl.boundary_recall - 0.04);
    ours += pair.ours.boundary_recall;
    of_pcl += pair.of_pcl.boundary_recall;
  }
  EXPECT_GE(ours, of_pcl - 0.01 * static_cast<double>(Pairs().size()));
}

// Along the voxels and without noise those of PCL are a little better.
TEST_F(SupervoxelQuality, LessCrossesBoundariesThanWithThoseOfPcl) {
  double ours = 0;
  double of_pcl = 0;
  for (const Pair& pair : Pairs()) {
    EXPECT_LE(pair.ours.under_segmentation, 1.25 * pair.of_pcl.under_segmentation);
    ours += pair.ours.under_segmentation;
    of_pcl += pair.of_pcl.under_segmentation;
  }
  EXPECT_LE(ours, of_pcl);
}

// Many small supervoxels would find every boundary and cross none.
TEST_F(SupervoxelQuality, ThereAreNotManyMoreThanOfPcl) {
  for (const Pair& pair : Pairs()) {
    EXPECT_LE(static_cast<double>(pair.ours.num_supervoxels),
              1.15 * static_cast<double>(pair.of_pcl.num_supervoxels));
  }
}

}  // namespace
}  // namespace semslam

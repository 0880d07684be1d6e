// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "semslam/base/random.h"

#include "segmentation/patches.h"
#include "segmentation/plane_hypotheses.h"
#include "segmentation/plane_scores.h"
#include "segmentation/plane_selection.h"
#include "segmentation/synthetic_scene.h"

namespace semslam {
namespace {

Patch MakePatch(const Eigen::Vector3d& centroid, const Eigen::Vector3d& normal, double area) {
  Patch patch;
  patch.centroid = centroid;
  patch.normal = normal.normalized();
  patch.area = area;
  patch.variation = 0;
  patch.num_voxels = 4;
  const Eigen::Vector3d u = patch.normal.unitOrthogonal();
  const Eigen::Vector3d v = patch.normal.cross(u);
  for (const double s : {-0.03, 0.03}) {
    patch.moments.Add(centroid + s * u + s * v);
    patch.moments.Add(centroid + s * u - s * v);
  }
  return patch;
}

// A square of patches every 8 cm.
void AddFloor(const Plane& plane, int side, std::vector<Patch>& patches) {
  const Eigen::Vector3d u = plane.normal.unitOrthogonal();
  const Eigen::Vector3d v = plane.normal.cross(u);
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const Eigen::Vector3d foot = -plane.offset * plane.normal;
      patches.push_back(MakePatch(foot + 0.08 * i * u + 0.08 * j * v, plane.normal, 0.0064));
    }
  }
}

bool AreSame(const Plane& a, const Plane& b) {
  const double sign = a.normal.dot(b.normal) < 0 ? -1 : 1;
  return (a.normal - sign * b.normal).norm() < 1e-3 && std::abs(a.offset - sign * b.offset) < 1e-3;
}

TEST(PlaneScores, CostIsTheDistanceAndAHundredTimesItAgainstTheNormal) {
  const Plane floor{Eigen::Vector3d::UnitZ(), -1};
  EXPECT_NEAR(PatchCost(MakePatch({0, 0, 1.02}, {0, 0, -1}, 1), floor, 0.8), 0.02, 1e-12);
  EXPECT_NEAR(PatchCost(MakePatch({0, 0, 1.02}, {1, 0, 0}, 1), floor, 0.8), 2.0, 1e-12);
}

TEST(PlaneScores, SupportIsSummedAsPublished) {
  const std::vector<Patch> patches = {MakePatch({0, 0, 0}, {0, 0, 1}, 0.5),
                                      MakePatch({1, 0, 0.02}, {0, 0, 1}, 0.25),
                                      MakePatch({1, 0, 0.02}, {0, 1, 0}, 4.0)};
  const std::vector<Plane> planes = {{Eigen::Vector3d::UnitZ(), 0}};
  const PlaneHypothesisOptions options;
  const double expected = 0.5 + 0.25 * std::exp(-1.0);
  EXPECT_NEAR(SoftSupports(PatchTable(patches), planes, options, 1)[0], expected, 1e-6);
  const SelectionEnergy energy = MakeSelectionEnergy(patches, planes, options, 2);
  EXPECT_NEAR(energy.unary[0], -expected / 0.1, 1e-9);
}

TEST(PlaneScores, SupportsOfManyPatchesAreTheirWeightedAreasSummed) {
  Random random(5);
  const auto any = [&](double reach) {
    return Eigen::Vector3d(reach * random.Uniform(), reach * random.Uniform(),
                           reach * random.Uniform());
  };
  std::vector<Patch> patches;
  for (int i = 0; i < 1001; ++i) {
    const Eigen::Vector3d normal = any(1) - Eigen::Vector3d::Constant(0.5);
    patches.push_back(MakePatch(any(3), normal, 0.01 * random.Uniform()));
  }
  const PlaneHypothesisOptions options;
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d normal = (any(1) - Eigen::Vector3d::Constant(0.5)).normalized();
    const std::vector<Plane> planes = {{normal, -normal.dot(any(3))}};
    double expected = 0;
    for (const Patch& patch : patches) {
      const double cost = PatchCost(patch, planes[0], options.min_normal_cosine);
      expected += patch.area * std::exp(-cost / (2 * options.tolerance));
    }
    // Weights below exp(-10) are left out.
    EXPECT_NEAR(SoftSupports(PatchTable(patches), planes, options, 1)[0], expected,
                1e-3 * expected + 1e-4);
  }
}

TEST(PlaneScores, ParallelAndSquarePlanesAgreeOthersDisagree) {
  const std::vector<Plane> planes = {{Eigen::Vector3d::UnitZ(), 0},
                                     {Eigen::Vector3d::UnitX(), 0},
                                     {-Eigen::Vector3d::UnitZ(), 3},
                                     {Eigen::Vector3d(1, 0, 1).normalized(), 0}};
  const SelectionEnergy energy = MakeSelectionEnergy({}, planes, PlaneHypothesisOptions(), 1);
  EXPECT_NEAR(energy.pairwise(0, 1), 0, 1e-12);
  EXPECT_NEAR(energy.pairwise(0, 2), 0, 1e-12);
  const double q = 1 - std::sqrt(0.5);
  EXPECT_NEAR(energy.pairwise(0, 3), 0.5 * (1 - std::exp(-q / 0.25)), 1e-12);
  EXPECT_TRUE(energy.pairwise.isApprox(energy.pairwise.transpose()));
}

TEST(PlaneScores, TheSamePlaneTwiceIsWorseThanOnce) {
  std::vector<Patch> patches;
  AddFloor({Eigen::Vector3d::UnitZ(), 0}, 5, patches);
  const std::vector<Plane> planes = {{Eigen::Vector3d::UnitZ(), 0}, {Eigen::Vector3d::UnitZ(), 0}};
  const SelectionEnergy energy = MakeSelectionEnergy(patches, planes, PlaneHypothesisOptions(), 1);
  EXPECT_LT(EnergyOf(energy, {true, false}), EnergyOf(energy, {true, true}));
}

TEST(PlaneHypotheses, OppositeSignsShareACell) {
  const PlaneHypothesisOptions options;
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const Plane plane{
        Eigen::Vector3d(random.Gaussian(), random.Gaussian(), random.Gaussian()).normalized(),
        random.Uniform(-2, 2)};
    const auto best = BestOfCells({plane, plane.Flipped()}, {1, 2}, {0.1, 0.2, 0.3}, options);
    ASSERT_EQ(best, std::vector<std::size_t>{1});
  }
}

TEST(PlaneHypotheses, CellsAreAboutEvenlyFineInAllDirections) {
  const PlaneHypothesisOptions options;
  Random random(3);
  for (const Eigen::Vector3d& pole :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(1, 1, 1)}) {
    std::vector<Plane> planes;
    for (int i = 0; i < 4000; ++i) {  // Within 10 degrees of the pole.
      const Eigen::Vector3d step(random.Uniform(-1, 1), random.Uniform(-1, 1),
                                 random.Uniform(-1, 1));
      planes.push_back({(pole.normalized() + 0.17 * step).normalized(), 0});
    }
    const std::size_t num_cells =
        BestOfCells(planes, std::vector<double>(planes.size(), 1), {0, 0, 0}, options).size();
    EXPECT_GT(num_cells, 200U) << pole.transpose();
    EXPECT_LT(num_cells, 900U) << pole.transpose();
  }
}

TEST(PlaneHypotheses, HoldThePlanesOfTheScene) {
  std::vector<Patch> patches;
  const Plane floor{Eigen::Vector3d::UnitZ(), 0.4};
  const Plane wall{Eigen::Vector3d(1, 2, 0).normalized(), -1};
  AddFloor(floor, 8, patches);
  AddFloor(wall, 6, patches);
  const std::vector<Plane> planes = ProposePlanes(patches, PlaneHypothesisOptions(), 1);
  EXPECT_TRUE(AreSame(planes.at(0), floor));  // The best supported comes first.
  EXPECT_TRUE(std::any_of(planes.begin(), planes.end(),
                          [&](const Plane& plane) { return AreSame(plane, wall); }));
}

TEST(PlaneHypotheses, RandomTriplesFindAPlaneNoSinglePatchShows) {
  std::vector<Patch> patches;
  const Plane floor{Eigen::Vector3d(0, 0.1, 1).normalized(), 0.4};
  AddFloor(floor, 8, patches);
  for (Patch& patch : patches) patch.variation = 0.05;  // All too rough to propose their own.
  const std::vector<Plane> planes = ProposePlanes(patches, PlaneHypothesisOptions(), 1);
  ASSERT_FALSE(planes.empty());
  EXPECT_TRUE(AreSame(planes[0], floor));
}

TEST(PlaneHypotheses, TooSmallOnesAreLeftOut) {
  const std::vector<Patch> patches = {MakePatch({0, 0, 0}, {0, 0, 1}, 0.009)};
  EXPECT_TRUE(ProposePlanes(patches, PlaneHypothesisOptions(), 1).empty());
}

SelectionEnergy RandomEnergy(int size, std::uint64_t seed) {
  Random random(seed);
  SelectionEnergy energy{Eigen::VectorXd(size), Eigen::MatrixXd::Zero(size, size)};
  for (int i = 0; i < size; ++i) {
    energy.unary[i] = -random.Uniform(0, 2);
    for (int j = 0; j < i; ++j) {
      energy.pairwise(i, j) = energy.pairwise(j, i) = random.Uniform(0, 0.5);
    }
  }
  return energy;
}

double LeastEnergy(const SelectionEnergy& energy) {
  const auto size = static_cast<std::size_t>(energy.unary.size());
  double least = 0;
  std::vector<bool> selected(size);
  for (std::size_t subset = 1; subset < (std::size_t{1} << size); ++subset) {
    for (std::size_t i = 0; i < size; ++i) selected[i] = (subset >> i & 1) != 0;
    least = std::min(least, EnergyOf(energy, selected));
  }
  return least;
}

TEST(PlaneSelection, FindsTheOptimumOfNearlyAllRandomProblems) {
  int num_optimal = 0;
  constexpr int kProblems = 200;
  for (int i = 0; i < kProblems; ++i) {
    const SelectionEnergy energy = RandomEnergy(10, i);
    const double reached = EnergyOf(energy, SelectPlanes(energy, PlaneSelectionOptions()));
    const double least = LeastEnergy(energy);
    ASSERT_GE(reached, least - 1e-9);
    num_optimal += reached <= least + 1e-9 ? 1 : 0;
  }
  EXPECT_GE(num_optimal, kProblems * 97 / 100);
}

TEST(PlaneSelection, FindsTheOptimumOfSixteenPlanes) {
  const SelectionEnergy energy = RandomEnergy(16, 99);
  EXPECT_NEAR(EnergyOf(energy, SelectPlanes(energy, PlaneSelectionOptions())), LeastEnergy(energy),
              1e-9);
}

TEST(PlaneSelection, LsaTrNeverEndsAboveItsStart) {
  for (int i = 0; i < 200; ++i) {
    const SelectionEnergy energy = RandomEnergy(12, 1000 + i);
    Random random(i);
    std::vector<bool> start(12);
    for (std::size_t k = 0; k < start.size(); ++k) start[k] = random.Uniform() < 0.5;
    const auto end = LsaTr(energy, start, PlaneSelectionOptions());
    ASSERT_LE(EnergyOf(energy, end), EnergyOf(energy, start));
  }
}

TEST(PlaneSelection, OnePlaneAndNoPlaneAreLegal) {
  const SelectionEnergy one{Eigen::VectorXd::Constant(1, -3), Eigen::MatrixXd::Zero(1, 1)};
  EXPECT_EQ(SelectPlanes(one, PlaneSelectionOptions()), std::vector<bool>{true});
  const SelectionEnergy none{Eigen::VectorXd(0), Eigen::MatrixXd(0, 0)};
  EXPECT_TRUE(SelectPlanes(none, PlaneSelectionOptions()).empty());
}

}  // namespace
}  // namespace semslam

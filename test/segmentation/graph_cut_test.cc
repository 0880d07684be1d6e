// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "semslam/base/random.h"

#include "segmentation/alpha_expansion.h"
#include "segmentation/max_flow.h"
#include "segmentation/plane_assignment.h"

namespace semslam {
namespace {

struct FlowProblem {
  struct Edge {
    std::size_t a, b;
    std::int64_t a_to_b, b_to_a;
  };
  std::vector<std::int64_t> from_source;
  std::vector<std::int64_t> to_sink;
  std::vector<Edge> edges;

  std::int64_t CutValue(const std::vector<bool>& on_source_side) const {
    std::int64_t value = 0;
    for (std::size_t i = 0; i < from_source.size(); ++i) {
      value += on_source_side[i] ? to_sink[i] : from_source[i];
    }
    for (const Edge& edge : edges) {
      if (on_source_side[edge.a] && !on_source_side[edge.b]) value += edge.a_to_b;
      if (on_source_side[edge.b] && !on_source_side[edge.a]) value += edge.b_to_a;
    }
    return value;
  }
};

FlowProblem RandomFlow(std::size_t num_nodes, std::uint64_t seed) {
  Random random(seed);
  FlowProblem problem;
  for (std::size_t i = 0; i < num_nodes; ++i) {
    problem.from_source.push_back(random.Index(20));
    problem.to_sink.push_back(random.Index(20));
    for (std::size_t j = 0; j < i; ++j) {
      if (random.Uniform() < 0.4) problem.edges.push_back({i, j, random.Index(9), random.Index(9)});
    }
  }
  return problem;
}

TEST(MaxFlow, ValueAndCutAreThoseOfAnExhaustiveSearch) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const FlowProblem problem = RandomFlow(9, seed);
    MaxFlow flow(9);
    for (std::size_t i = 0; i < 9; ++i) {
      flow.AddTerminals(i, problem.from_source[i], problem.to_sink[i]);
    }
    for (const auto& edge : problem.edges) flow.AddEdge(edge.a, edge.b, edge.a_to_b, edge.b_to_a);
    const std::int64_t value = flow.Solve();

    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    std::vector<bool> side(9);
    for (std::size_t subset = 0; subset < 512; ++subset) {
      for (std::size_t i = 0; i < 9; ++i) side[i] = (subset >> i & 1) != 0;
      least = std::min(least, problem.CutValue(side));
    }
    for (std::size_t i = 0; i < 9; ++i) side[i] = flow.IsOnSourceSide(i);
    ASSERT_EQ(value, least);
    ASSERT_EQ(problem.CutValue(side), least);
  }
}

LabelEnergy RandomLabelEnergy(std::size_t num_nodes, std::size_t num_labels, std::uint64_t seed) {
  Random random(seed);
  LabelEnergy energy;
  energy.num_nodes = num_nodes;
  energy.num_labels = num_labels;
  for (std::size_t i = 0; i < num_nodes * num_labels; ++i) energy.costs.push_back(random.Index(30));
  for (std::uint32_t i = 0; i < num_nodes; ++i) {
    for (std::uint32_t j = 0; j < i; ++j) {
      if (random.Uniform() < 0.5) energy.edges.push_back({j, i, random.Index(12)});
    }
  }
  return energy;
}

// Calls visit with every assignment of num_choices values to num_nodes nodes.
template <typename Visitor>
void ForAllChoices(std::size_t num_nodes, std::uint32_t num_choices, const Visitor& visit) {
  std::vector<std::uint32_t> choice(num_nodes, 0);
  while (true) {
    visit(choice);
    std::size_t i = 0;
    while (i < num_nodes && ++choice[i] == num_choices) choice[i++] = 0;
    if (i == num_nodes) return;
  }
}

TEST(AlphaExpansion, OneMoveIsTheBestOfAllMoves) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const LabelEnergy energy = RandomLabelEnergy(8, 4, seed);
    const auto start = CheapestLabels(energy);
    for (std::uint32_t label = 0; label < 4; ++label) {
      std::int64_t least = std::numeric_limits<std::int64_t>::max();
      ForAllChoices(8, 2, [&](const std::vector<std::uint32_t>& takes) {
        std::vector<std::uint32_t> moved = start;
        for (std::size_t i = 0; i < 8; ++i) {
          if (takes[i] == 1) moved[i] = label;
        }
        least = std::min(least, EnergyOf(energy, moved));
      });
      ASSERT_EQ(EnergyOf(energy, Expand(energy, start, label)), least) << "seed " << seed;
    }
  }
}

TEST(AlphaExpansion, TwoLabelsReachTheOptimum) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const LabelEnergy energy = RandomLabelEnergy(10, 2, seed);
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    ForAllChoices(10, 2, [&](const std::vector<std::uint32_t>& labels) {
      least = std::min(least, EnergyOf(energy, labels));
    });
    const auto labels = MinimiseByExpansion(energy, CheapestLabels(energy), 10);
    ASSERT_EQ(EnergyOf(energy, labels), least);
  }
}

// The move's guarantee for different-label costs is a factor of two; small graphs nearly always
// reach the optimum.
TEST(AlphaExpansion, FourLabelsReachTheOptimumNearlyAlways) {
  int num_optimal = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const LabelEnergy energy = RandomLabelEnergy(6, 4, seed);
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    ForAllChoices(6, 4, [&](const std::vector<std::uint32_t>& labels) {
      least = std::min(least, EnergyOf(energy, labels));
    });
    const std::int64_t reached =
        EnergyOf(energy, MinimiseByExpansion(energy, CheapestLabels(energy), 10));
    ASSERT_LE(reached, 2 * least);
    num_optimal += reached == least ? 1 : 0;
  }
  EXPECT_GE(num_optimal, 36);
}

TEST(AlphaExpansion, EnergyNeverRises) {
  const LabelEnergy energy = RandomLabelEnergy(60, 8, 5);
  auto labels = CheapestLabels(energy);
  for (std::uint32_t step = 0; step < 24; ++step) {
    auto moved = Expand(energy, labels, step % 8);
    ASSERT_LE(EnergyOf(energy, moved), EnergyOf(energy, labels));
    labels = std::move(moved);
  }
}

PatchGraph RowOfPatches(const std::vector<double>& heights) {
  PatchGraph graph;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    Patch patch;
    patch.centroid = {0.08 * static_cast<double>(i), 0, heights[i]};
    patch.normal = Eigen::Vector3d::UnitZ();
    patch.area = 0.0064;
    graph.patches.push_back(patch);
    if (i > 0) {
      graph.edges.push_back({static_cast<std::uint32_t>(i - 1), static_cast<std::uint32_t>(i), 10});
    }
  }
  return graph;
}

TEST(PlaneAssignment, NeighboursPullANoisyPatchIntoThePlane) {
  // The fourth lies 1.5 tau off: alone it would be of no plane.
  const PatchGraph graph = RowOfPatches({0, 0, 0, 0.015, 0, 0, 0});
  const auto labels = AssignPlanes(graph, {{Eigen::Vector3d::UnitZ(), 0}}, PlaneHypothesisOptions(),
                                   PlaneAssignmentOptions());
  EXPECT_EQ(labels, std::vector<std::uint32_t>(7, 1));
}

TEST(PlaneAssignment, PatchesFarFromAllPlanesGetNone) {
  const PatchGraph graph = RowOfPatches({0, 0, 0.2, 0.2, 0.5, 0.5});
  const auto labels =
      AssignPlanes(graph, {{Eigen::Vector3d::UnitZ(), 0}, {Eigen::Vector3d::UnitZ(), -0.5}},
                   PlaneHypothesisOptions(), PlaneAssignmentOptions());
  EXPECT_EQ(labels, (std::vector<std::uint32_t>{1, 1, 0, 0, 2, 2}));
}

}  // namespace
}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "semslam/geometry/rigid3.h"

namespace semslam {

// Poses, and what is known of how they lie to each other. Nodes are named by their place in the
// vector.
struct PoseGraph {
  struct Edge {
    int from = 0;
    int to = 0;
    Rigid3 T_from_to;   // As measured.
    double weight = 1;  // Of the squared error, for rotation (rad) and translation (m) alike; > 0.
  };

  std::vector<Rigid3> T_world_node = {};
  std::vector<std::uint8_t> is_fixed = {};  // One a node: 1 if it must not move.
  std::vector<Edge> edges = {};
};

struct PoseGraphOptions {
  int max_iterations = 50;
  // It ends when a step lowers the cost by less than this fraction.
  double relative_tolerance = 1e-6;
  void Validate() const;  // Throws std::logic_error.
};

struct PoseGraphSolution {
  std::vector<Rigid3> T_world_node = {};  // Fixed nodes come back unchanged, to the bit.
  double initial_cost = 0;                // Weighted sum of squared errors, before and after.
  double final_cost = 0;
  int num_iterations = 0;
};

// The poses that agree best with the edges, by Levenberg-Marquardt on the sparse normal equations
// (rigid case of the graphs of Strasdat, Montiel, Davison, "Scale Drift-Aware Large Scale Monocular
// SLAM", 2010). If no node is fixed, the first is. Nodes that no chain of edges ties to a fixed one
// keep their places as far as the edges let them.
PoseGraphSolution OptimizePoseGraph(const PoseGraph& graph, const PoseGraphOptions& options = {});

}  // namespace semslam

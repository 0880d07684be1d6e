// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace semslam {

// Costs of giving one of a few labels to every node of a graph. Costs are whole, so that energies
// compare exactly; multiply real ones by what resolves them.
struct LabelEnergy {
  struct Edge {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    std::int64_t weight = 0;  // Cost of different labels at a and b, >= 0.
  };

  std::size_t num_nodes = 0;
  std::size_t num_labels = 0;
  std::vector<std::int64_t> costs;  // [node * num_labels + label].
  std::vector<Edge> edges;          // Each pair once.

  std::int64_t CostOf(std::size_t node, std::uint32_t label) const {
    return costs[node * num_labels + label];
  }
};

std::int64_t EnergyOf(const LabelEnergy& energy, const std::vector<std::uint32_t>& labels);

// The cheapest label of every node by itself; the lower of equals.
std::vector<std::uint32_t> CheapestLabels(const LabelEnergy& energy);

// The labels after the best move in which any set of nodes takes `label` at once, found by one
// least cut; `labels` itself unless that lowers the energy.
std::vector<std::uint32_t> Expand(const LabelEnergy& energy,
                                  std::vector<std::uint32_t> labels,
                                  std::uint32_t label);

// Alpha-expansion (Boykov, Veksler and Zabih, PAMI 2001): expands one label after the other until
// none lowers the energy, `max_sweeps` times at most.
std::vector<std::uint32_t> MinimiseByExpansion(const LabelEnergy& energy,
                                               std::vector<std::uint32_t> labels,
                                               int max_sweeps);

}  // namespace semslam

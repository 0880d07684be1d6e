// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/alpha_expansion.h"

#include <limits>

#include "segmentation/max_flow.h"

namespace semslam {
namespace {

constexpr std::uint32_t kFixed = std::numeric_limits<std::uint32_t>::max();

// Numbers the nodes that may gain by taking the label. A node whose own cost rises by more than all
// its edges can save keeps its label in every best move.
std::vector<std::uint32_t> NumberOpenNodes(const LabelEnergy& energy,
                                           const std::vector<std::uint32_t>& labels,
                                           const std::vector<std::int64_t>& edge_sums,
                                           std::uint32_t label,
                                           std::uint32_t& num_open) {
  std::vector<std::uint32_t> numbers(energy.num_nodes, kFixed);
  num_open = 0;
  for (std::size_t node = 0; node < energy.num_nodes; ++node) {
    if (labels[node] == label) continue;
    const std::int64_t rise = energy.CostOf(node, label) - energy.CostOf(node, labels[node]);
    if (rise < edge_sums[node]) numbers[node] = num_open++;
  }
  return numbers;
}

// Whether a node takes the label (source side) or keeps its own (sink side).
class ExpansionGraph {
 public:
  explicit ExpansionGraph(std::size_t num_nodes) : flow_(num_nodes), extra_of_taking_(num_nodes) {}

  void AddCostOfTaking(std::uint32_t node, std::int64_t cost) { extra_of_taking_[node] += cost; }

  // Costs for (a, b) = (keep, keep), (keep, take), (take, keep); none for (take, take).
  void AddPair(std::uint32_t a,
               std::uint32_t b,
               std::int64_t keep_keep,
               std::int64_t keep_take,
               std::int64_t take_keep) {
    // With x = 1 for take: E = kk + (tk - kk) x_a - tk x_b + (kt + tk - kk) (1 - x_a) x_b.
    AddCostOfTaking(a, take_keep - keep_keep);
    AddCostOfTaking(b, -take_keep);
    flow_.AddEdge(b, a, keep_take + take_keep - keep_keep, 0);
  }

  void Solve() {
    for (std::size_t node = 0; node < extra_of_taking_.size(); ++node) {
      const std::int64_t extra = extra_of_taking_[node];
      flow_.AddTerminals(node, extra < 0 ? -extra : 0, extra > 0 ? extra : 0);
    }
    flow_.Solve();
  }
  bool Takes(std::uint32_t node) const { return flow_.IsOnSourceSide(node); }

 private:
  MaxFlow flow_;
  std::vector<std::int64_t> extra_of_taking_;
};

std::vector<std::int64_t> SumOfEdges(const LabelEnergy& energy) {
  std::vector<std::int64_t> sums(energy.num_nodes, 0);
  for (const LabelEnergy::Edge& edge : energy.edges) {
    sums[edge.a] += edge.weight;
    sums[edge.b] += edge.weight;
  }
  return sums;
}

}  // namespace

std::int64_t EnergyOf(const LabelEnergy& energy, const std::vector<std::uint32_t>& labels) {
  std::int64_t sum = 0;
  for (std::size_t node = 0; node < energy.num_nodes; ++node) {
    sum += energy.CostOf(node, labels[node]);
  }
  for (const LabelEnergy::Edge& edge : energy.edges) {
    if (labels[edge.a] != labels[edge.b]) sum += edge.weight;
  }
  return sum;
}

std::vector<std::uint32_t> CheapestLabels(const LabelEnergy& energy) {
  std::vector<std::uint32_t> labels(energy.num_nodes, 0);
  for (std::size_t node = 0; node < energy.num_nodes; ++node) {
    for (std::uint32_t label = 1; label < energy.num_labels; ++label) {
      if (energy.CostOf(node, label) < energy.CostOf(node, labels[node])) labels[node] = label;
    }
  }
  return labels;
}

std::vector<std::uint32_t> Expand(const LabelEnergy& energy,
                                  std::vector<std::uint32_t> labels,
                                  std::uint32_t label) {
  std::uint32_t num_open = 0;
  const std::vector<std::uint32_t> numbers =
      NumberOpenNodes(energy, labels, SumOfEdges(energy), label, num_open);
  if (num_open == 0) return labels;

  ExpansionGraph graph(num_open);
  for (std::size_t node = 0; node < energy.num_nodes; ++node) {
    if (numbers[node] == kFixed) continue;
    graph.AddCostOfTaking(numbers[node],
                          energy.CostOf(node, label) - energy.CostOf(node, labels[node]));
  }
  for (const LabelEnergy::Edge& edge : energy.edges) {
    const std::uint32_t a = numbers[edge.a];
    const std::uint32_t b = numbers[edge.b];
    const std::int64_t keep_keep = labels[edge.a] != labels[edge.b] ? edge.weight : 0;
    if (a != kFixed && b != kFixed) {
      graph.AddPair(a, b, keep_keep, edge.weight, edge.weight);
    } else if (a != kFixed || b != kFixed) {
      const std::uint32_t fixed_label = a == kFixed ? labels[edge.a] : labels[edge.b];
      const std::int64_t take_keep = fixed_label != label ? edge.weight : 0;
      graph.AddCostOfTaking(a == kFixed ? b : a, take_keep - keep_keep);
    }
  }
  graph.Solve();
  std::vector<std::uint32_t> moved = labels;
  for (std::size_t node = 0; node < energy.num_nodes; ++node) {
    if (numbers[node] != kFixed && graph.Takes(numbers[node])) moved[node] = label;
  }
  return EnergyOf(energy, moved) < EnergyOf(energy, labels) ? moved : labels;
}

std::vector<std::uint32_t> MinimiseByExpansion(const LabelEnergy& energy,
                                               std::vector<std::uint32_t> labels,
                                               int max_sweeps) {
  std::size_t num_unchanged = 0;
  for (int sweep = 0; sweep < max_sweeps; ++sweep) {
    for (std::uint32_t label = 0; label < energy.num_labels; ++label) {
      std::vector<std::uint32_t> moved = Expand(energy, labels, label);
      num_unchanged = moved == labels ? num_unchanged + 1 : 0;
      if (num_unchanged == energy.num_labels) return labels;
      labels = std::move(moved);
    }
  }
  return labels;
}

}  // namespace semslam

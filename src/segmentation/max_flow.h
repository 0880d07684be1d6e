// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace semslam {

// The least cut of a graph between a source and a sink (Dinic 1970: shortest augmenting paths,
// level by level). Whole capacities, so that the result is exact.
class MaxFlow {
 public:
  explicit MaxFlow(std::size_t num_nodes) : source_(num_nodes), sink_(num_nodes + 1) {
    first_arc_.assign(num_nodes + 2, kNoArc);
  }

  // Arcs source -> node and node -> sink. May be called again for the same node.
  void AddTerminals(std::size_t node, std::int64_t from_source, std::int64_t to_sink);
  // Arcs a -> b and b -> a.
  void AddEdge(std::size_t a, std::size_t b, std::int64_t a_to_b, std::int64_t b_to_a);

  // Once. The value of the flow, which is that of the cut.
  std::int64_t Solve();
  // After Solve: which side of the least cut (of several, the one with the fewest source nodes).
  bool IsOnSourceSide(std::size_t node) const { return level_[node] >= 0; }

 private:
  static constexpr std::uint32_t kNoArc = 0xffffffff;
  struct Arc {
    std::uint32_t head = 0;
    std::uint32_t next = kNoArc;  // Of the same tail.
    std::int64_t residual = 0;    // The opposite arc is at index ^ 1.
  };

  void AddArcPair(std::size_t a, std::size_t b, std::int64_t a_to_b, std::int64_t b_to_a);
  bool FindLevels();
  // One path along rising levels, found and saturated; 0 when there is none left.
  std::int64_t Augment();

  std::size_t source_;
  std::size_t sink_;
  std::vector<std::uint32_t> first_arc_;
  std::vector<Arc> arcs_;
  std::vector<int> level_;
  std::vector<std::uint32_t> current_arc_;
  std::vector<std::uint32_t> path_;
  std::vector<std::size_t> queue_;
};

}  // namespace semslam

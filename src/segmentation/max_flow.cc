// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/max_flow.h"

#include <algorithm>
#include <limits>

namespace semslam {

void MaxFlow::AddArcPair(std::size_t a, std::size_t b, std::int64_t a_to_b, std::int64_t b_to_a) {
  const auto index = static_cast<std::uint32_t>(arcs_.size());
  arcs_.push_back({static_cast<std::uint32_t>(b), first_arc_[a], a_to_b});
  first_arc_[a] = index;
  arcs_.push_back({static_cast<std::uint32_t>(a), first_arc_[b], b_to_a});
  first_arc_[b] = index + 1;
}

void MaxFlow::AddTerminals(std::size_t node, std::int64_t from_source, std::int64_t to_sink) {
  if (from_source > 0) AddArcPair(source_, node, from_source, 0);
  if (to_sink > 0) AddArcPair(node, sink_, to_sink, 0);
}

void MaxFlow::AddEdge(std::size_t a, std::size_t b, std::int64_t a_to_b, std::int64_t b_to_a) {
  AddArcPair(a, b, a_to_b, b_to_a);
}

bool MaxFlow::FindLevels() {
  level_.assign(first_arc_.size(), -1);
  level_[source_] = 0;
  queue_.assign(1, source_);
  for (std::size_t next = 0; next < queue_.size(); ++next) {
    const std::size_t node = queue_[next];
    for (std::uint32_t arc = first_arc_[node]; arc != kNoArc; arc = arcs_[arc].next) {
      const std::size_t head = arcs_[arc].head;
      if (arcs_[arc].residual <= 0 || level_[head] >= 0) continue;
      level_[head] = level_[node] + 1;
      queue_.push_back(head);
    }
  }
  return level_[sink_] >= 0;
}

std::int64_t MaxFlow::Augment() {
  path_.clear();
  std::size_t node = source_;
  while (node != sink_) {
    std::uint32_t& arc = current_arc_[node];
    while (arc != kNoArc &&
           (arcs_[arc].residual <= 0 || level_[arcs_[arc].head] != level_[node] + 1)) {
      arc = arcs_[arc].next;
    }
    if (arc != kNoArc) {  // Advance.
      path_.push_back(arc);
      node = arcs_[arc].head;
      continue;
    }
    if (path_.empty()) return 0;
    node = arcs_[path_.back() ^ 1].head;  // Retreat: that arc leads nowhere.
    path_.pop_back();
    current_arc_[node] = arcs_[current_arc_[node]].next;
  }
  std::int64_t flow = std::numeric_limits<std::int64_t>::max();
  for (const std::uint32_t arc : path_) flow = std::min(flow, arcs_[arc].residual);
  for (const std::uint32_t arc : path_) {
    arcs_[arc].residual -= flow;
    arcs_[arc ^ 1].residual += flow;
  }
  return flow;
}

std::int64_t MaxFlow::Solve() {
  std::int64_t total = 0;
  while (FindLevels()) {
    current_arc_ = first_arc_;
    while (const std::int64_t flow = Augment()) total += flow;
  }
  return total;
}

}  // namespace semslam

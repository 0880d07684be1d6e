// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/surface_growth.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <queue>
#include <tuple>

#include "segmentation/disjoint_sets.h"

namespace semslam {
namespace {

// Patches of pieces of a plane that are large enough to grow.
std::vector<bool> FindCores(const PatchGraph& graph,
                            const std::vector<std::uint32_t>& plane_labels,
                            double min_area) {
  DisjointSets sets(graph.patches.size());
  for (const PatchEdge& edge : graph.edges) {
    if (plane_labels[edge.a] == plane_labels[edge.b]) sets.Join(edge.a, edge.b);
  }
  std::vector<double> areas(graph.patches.size(), 0.0);
  for (std::uint32_t i = 0; i < areas.size(); ++i) areas[sets.Find(i)] += graph.patches[i].area;
  std::vector<bool> is_core(areas.size());
  for (std::uint32_t i = 0; i < areas.size(); ++i) {
    is_core[i] = plane_labels[i] != 0 && areas[sets.Find(i)] >= min_area;
  }
  return is_core;
}

// For every patch its flush neighbours.
std::vector<std::vector<std::uint32_t>> FlushNeighbours(const PatchGraph& graph,
                                                        const ComponentOptions& options) {
  std::vector<std::vector<std::uint32_t>> neighbours(graph.patches.size());
  for (const PatchEdge& edge : graph.edges) {
    if (!IsFlush(graph.patches[edge.a], graph.patches[edge.b], options)) continue;
    neighbours[edge.a].push_back(edge.b);
    neighbours[edge.b].push_back(edge.a);
  }
  return neighbours;
}

}  // namespace

bool IsFlush(const Patch& a, const Patch& b, const ComponentOptions& options) {
  if (a.normal.dot(b.normal) < std::cos(options.concavity_tolerance)) return false;
  const Eigen::Vector3d offset = a.centroid - b.centroid;
  return std::max(std::abs(a.normal.dot(offset)), std::abs(b.normal.dot(offset))) <=
         options.flush_tolerance;
}

std::vector<std::uint32_t> GrowSurfaces(const PatchGraph& graph,
                                        const std::vector<Plane>& planes,
                                        std::vector<std::uint32_t> plane_labels,
                                        const ComponentOptions& options) {
  const auto neighbours = FlushNeighbours(graph, options);
  // Distance to the plane, patch, label: the nearest first, then by number.
  using Offer = std::tuple<double, std::uint32_t, std::uint32_t>;
  std::priority_queue<Offer, std::vector<Offer>, std::greater<>> offers;
  const auto offer_to_neighbours = [&](std::uint32_t patch) {
    const std::uint32_t label = plane_labels[patch];
    for (const std::uint32_t other : neighbours[patch]) {
      if (plane_labels[other] != 0) continue;
      const double distance =
          std::abs(planes[label - 1].SignedDistance(graph.patches[other].centroid));
      if (distance <= options.warp_tolerance) offers.emplace(distance, other, label);
    }
  };
  const std::vector<bool> is_core = FindCores(graph, plane_labels, options.min_core_area);
  for (std::uint32_t i = 0; i < is_core.size(); ++i) {
    if (is_core[i]) offer_to_neighbours(i);
  }
  while (!offers.empty()) {
    const auto [distance, patch, label] = offers.top();
    offers.pop();
    if (plane_labels[patch] != 0) continue;
    plane_labels[patch] = label;
    offer_to_neighbours(patch);
  }
  return plane_labels;
}

}  // namespace semslam

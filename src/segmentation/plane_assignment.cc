// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/plane_assignment.h"

#include <algorithm>
#include <cmath>

#include "segmentation/plane_scores.h"

namespace semslam {
namespace {

// Nanometres; a patch 10 km off costs what one 1 km off does.
std::int64_t ToWhole(double cost) {
  constexpr double kScale = 1e9;
  constexpr double kMaxCost = 1e3;
  return static_cast<std::int64_t>(std::llround(std::min(cost, kMaxCost) * kScale));
}

}  // namespace

LabelEnergy MakeAssignmentEnergy(const PatchGraph& graph,
                                 const std::vector<Plane>& planes,
                                 const PlaneHypothesisOptions& plane_options,
                                 const PlaneAssignmentOptions& options) {
  LabelEnergy energy;
  energy.num_nodes = graph.patches.size();
  energy.num_labels = planes.size() + 1;
  energy.costs.reserve(energy.num_nodes * energy.num_labels);
  for (const Patch& patch : graph.patches) {
    energy.costs.push_back(ToWhole(options.no_plane_cost * plane_options.tolerance));
    for (const Plane& plane : planes) {
      energy.costs.push_back(ToWhole(PatchCost(patch, plane, plane_options.min_normal_cosine)));
    }
  }
  energy.edges.reserve(graph.edges.size());
  for (const PatchEdge& edge : graph.edges) {
    const double cosine = std::abs(graph.patches[edge.a].normal.dot(graph.patches[edge.b].normal));
    if (cosine < options.min_smooth_cosine) continue;
    energy.edges.push_back(
        {edge.a, edge.b, ToWhole(cosine * options.smoothness * plane_options.tolerance)});
  }
  return energy;
}

std::vector<std::uint32_t> AssignPlanes(const PatchGraph& graph,
                                        const std::vector<Plane>& planes,
                                        const PlaneHypothesisOptions& plane_options,
                                        const PlaneAssignmentOptions& options) {
  const LabelEnergy energy = MakeAssignmentEnergy(graph, planes, plane_options, options);
  return MinimiseByExpansion(energy, CheapestLabels(energy), options.max_sweeps);
}

}  // namespace semslam

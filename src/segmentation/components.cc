// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/components.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "segmentation/disjoint_sets.h"
#include "segmentation/floating_parts.h"
#include "segmentation/surface_growth.h"
#include "segmentation/thing_parts.h"

namespace semslam {
namespace {

double ToDegrees(double radians) { return radians * (180.0 / std::numbers::pi); }

// How far one patch lies off the other's tangent plane, more than a bend by `angle` explains.
bool HasStep(const Patch& a, const Patch& b, double angle, double tolerance) {
  const Eigen::Vector3d offset = a.centroid - b.centroid;
  const double step = std::min(std::abs(a.normal.dot(offset)), std::abs(b.normal.dot(offset)));
  return step > offset.norm() * std::sin(angle) + tolerance;
}

// Contacts along the line in which the two tangent planes meet say nothing about their bend.
bool IsSideways(const Patch& a, const Patch& b, double angle) {
  const double threshold = 57.0 / (1.0 + std::exp(-0.3 * (ToDegrees(angle) - 33.0)));
  const Eigen::Vector3d line = a.normal.cross(b.normal);
  const Eigen::Vector3d offset = a.centroid - b.centroid;
  const double sine = line.cross(offset).norm();
  const double cosine = std::abs(line.dot(offset));
  return ToDegrees(std::atan2(sine, cosine)) < threshold;
}

// Smooth, and flat or bent outwards.
bool BendsOutwards(const Patch& a, const Patch& b, double angle, const ComponentOptions& options) {
  if (HasStep(a, b, angle, options.step_tolerance)) return false;
  return angle <= options.concavity_tolerance ||
         (a.normal - b.normal).dot(a.centroid - b.centroid) > 0;
}

double AngleBetween(const Patch& a, const Patch& b) {
  return std::acos(std::clamp(a.normal.dot(b.normal), -1.0, 1.0));
}

bool IsOn(const PatchGraph& graph,
          const PatchEdge& edge,
          const std::vector<std::uint32_t>& plane_labels,
          const ComponentOptions& options) {
  if (plane_labels[edge.a] != plane_labels[edge.b]) return false;
  return plane_labels[edge.a] != 0 ||
         IsConvex(graph.patches[edge.a], graph.patches[edge.b], options);
}

struct Border {
  double num_contacts = 0;
  double num_joining = 0;
};

// Joins components over borders of whose contacts most are between patches that `joins`, among the
// pairs of components (given by their representatives) that `may_join`.
template <typename MayJoin, typename Joins>
void JoinAcrossBorders(const PatchGraph& graph,
                       const MayJoin& may_join,
                       const Joins& joins,
                       DisjointSets& sets) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Border> borders;
  for (const PatchEdge& edge : graph.edges) {
    const std::uint32_t a = sets.Find(edge.a);
    const std::uint32_t b = sets.Find(edge.b);
    if (a == b || !may_join(a, b)) continue;
    Border& border = borders[std::minmax(a, b)];
    border.num_contacts += edge.num_contacts;
    if (joins(graph.patches[edge.a], graph.patches[edge.b])) {
      border.num_joining += edge.num_contacts;
    }
  }
  for (const auto& [pair, border] : borders) {
    if (border.num_joining > 0.5 * border.num_contacts) sets.Join(pair.first, pair.second);
  }
}

// Distance between the nearest centroids of two sets of patches.
double GapBetween(const PatchGraph& graph,
                  const std::vector<std::uint32_t>& a,
                  const std::vector<std::uint32_t>& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t i : a) {
    for (const std::uint32_t j : b) {
      least =
          std::min(least, (graph.patches[i].centroid - graph.patches[j].centroid).squaredNorm());
    }
  }
  return std::sqrt(least);
}

// Large pieces of one plane are one surface that something hides part of: a wall behind a monitor.
void JoinAcrossGaps(const PatchGraph& graph,
                    const std::vector<std::uint32_t>& plane_labels,
                    const ComponentOptions& options,
                    DisjointSets& sets,
                    std::vector<bool>& is_structural) {
  constexpr double kMinShare = 0.9;
  const std::vector<double> areas = AreasOf(graph, sets);
  struct Piece {
    std::vector<std::uint32_t> patches;
    double area = 0;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Piece> pieces;  // By label, representative.
  for (std::uint32_t i = 0; i < areas.size(); ++i) {
    if (plane_labels[i] == 0) continue;
    Piece& piece = pieces[{plane_labels[i], sets.Find(i)}];
    piece.patches.push_back(i);
    piece.area += graph.patches[i].area;
  }
  std::erase_if(pieces, [&](const auto& item) {
    // Faces of things are no pieces of a wall.
    const std::uint32_t representative = item.first.second;
    const bool is_face =
        !is_structural[representative] && item.second.area < kMinShare * areas[representative];
    return is_face || item.second.area < options.min_piece_area;
  });
  const std::vector<bool> was_structural = is_structural;
  for (auto a = pieces.begin(); a != pieces.end(); ++a) {
    for (auto b = std::next(a); b != pieces.end() && b->first.first == a->first.first; ++b) {
      const std::uint32_t first = a->first.second;
      const std::uint32_t second = b->first.second;
      if (!was_structural[first] && !was_structural[second]) continue;
      if (GapBetween(graph, a->second.patches, b->second.patches) > options.max_gap) continue;
      sets.Join(first, second);
      is_structural[first] = is_structural[second] = true;
    }
  }
}

// By representative: whether it is a plane of structural size.
std::vector<bool> FindStructural(const PatchGraph& graph,
                                 const std::vector<std::uint32_t>& plane_labels,
                                 double min_area,
                                 DisjointSets& sets) {
  std::vector<double> areas(graph.patches.size(), 0.0);
  for (std::uint32_t i = 0; i < graph.patches.size(); ++i) {
    if (plane_labels[i] != 0) areas[sets.Find(i)] += graph.patches[i].area;
  }
  std::vector<bool> is_structural(areas.size());
  for (std::size_t i = 0; i < areas.size(); ++i) is_structural[i] = areas[i] >= min_area;
  return is_structural;
}

// The one plane of all patches; of a structural component, which may be warped, the plane of most
// of its area.
std::uint32_t PlaneOf(const Component& component,
                      const PatchGraph& graph,
                      const std::vector<std::uint32_t>& plane_labels) {
  std::map<std::uint32_t, double> areas;
  for (const std::uint32_t patch : component.patches) {
    areas[plane_labels[patch]] += graph.patches[patch].area;
  }
  if (areas.size() > 1 && !component.is_structural) return 0;
  const auto largest = std::max_element(
      areas.begin(), areas.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return largest->first;
}

Components Collect(const PatchGraph& graph,
                   const std::vector<std::uint32_t>& plane_labels,
                   const std::vector<bool>& is_structural,
                   const ComponentOptions& options,
                   DisjointSets& sets) {
  std::vector<Component> by_representative(graph.patches.size());
  for (std::uint32_t i = 0; i < graph.patches.size(); ++i) {
    Component& component = by_representative[sets.Find(i)];
    component.patches.push_back(i);
    component.area += graph.patches[i].area;
    component.is_structural = component.is_structural || is_structural[i];
  }
  Components result;
  result.component_of_patch.assign(graph.patches.size(), kNoComponent);
  for (std::uint32_t i = 0; i < by_representative.size(); ++i) {
    Component& component = by_representative[i];
    if (component.patches.empty()) continue;
    if (component.patches.size() < options.min_patches && component.area < options.min_area)
      continue;
    component.plane_label = PlaneOf(component, graph, plane_labels);
    for (const std::uint32_t patch : component.patches) {
      result.component_of_patch[patch] = static_cast<std::uint32_t>(result.components.size());
    }
    result.components.push_back(std::move(component));
  }
  return result;
}

}  // namespace

bool IsConvex(const Patch& a, const Patch& b, const ComponentOptions& options) {
  const double angle = AngleBetween(a, b);
  return BendsOutwards(a, b, angle, options) &&
         (angle <= options.concavity_tolerance || !IsSideways(a, b, angle));
}

Components FindComponents(const PatchGraph& graph,
                          const std::vector<std::uint32_t>& plane_labels,
                          const ComponentOptions& options,
                          const PatchPlaces& places) {
  DisjointSets sets(graph.patches.size());
  for (const PatchEdge& edge : graph.edges) {
    if (IsOn(graph, edge, plane_labels, options)) sets.Join(edge.a, edge.b);
  }
  std::vector<bool> is_structural =
      FindStructural(graph, plane_labels, options.min_structural_area, sets);
  JoinAcrossBorders(
      graph,
      [&](std::uint32_t a, std::uint32_t b) { return !is_structural[a] && !is_structural[b]; },
      [&](const Patch& a, const Patch& b) {
        return BendsOutwards(a, b, AngleBetween(a, b), options);
      },
      sets);
  JoinAcrossBorders(
      graph, [&](std::uint32_t a, std::uint32_t b) { return is_structural[a] && is_structural[b]; },
      [&](const Patch& a, const Patch& b) { return IsFlush(a, b, options); }, sets);
  JoinAcrossGaps(graph, plane_labels, options, sets, is_structural);
  JoinThingParts(graph, is_structural, options, sets);
  JoinFloatingParts({graph, plane_labels, is_structural, places}, options, sets);
  return Collect(graph, plane_labels, is_structural, options, sets);
}

}  // namespace semslam

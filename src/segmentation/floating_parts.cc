// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/floating_parts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include <Eigen/LU>

#include "segmentation/thing_parts.h"

namespace semslam {
namespace {

constexpr std::uint32_t kNothing = std::numeric_limits<std::uint32_t>::max();

// How far a patch reaches from its centroid, at most: more than an even disc of the same moments.
double MaxReachOf(const Patch& patch) {
  return 2 * std::sqrt(std::max(0.0, patch.moments.Covariance().trace()));
}

// By representative: whether it touches nothing at all.
std::vector<bool> FindUntouched(const PatchGraph& graph, DisjointSets& sets) {
  std::vector<bool> is_untouched(graph.patches.size(), true);
  for (const PatchEdge& edge : graph.edges) {
    const std::uint32_t a = sets.Find(edge.a);
    const std::uint32_t b = sets.Find(edge.b);
    if (a != b) is_untouched[a] = is_untouched[b] = false;
  }
  return is_untouched;
}

// By representative: whether it touches nothing and continues a floor, wall or table that goes on
// somewhere else.
std::vector<bool> FindPiecesOfSurfaces(const PartsOfScene& scene,
                                       const std::vector<bool>& is_untouched,
                                       DisjointSets& sets) {
  std::set<std::uint32_t> labels;
  for (std::uint32_t i = 0; i < scene.plane_labels.size(); ++i) {
    if (scene.is_structural[sets.Find(i)]) labels.insert(scene.plane_labels[i]);
  }
  labels.erase(0);
  std::vector<bool> is_piece = is_untouched;
  for (std::uint32_t i = 0; i < scene.plane_labels.size(); ++i) {
    if (!labels.contains(scene.plane_labels[i])) is_piece[sets.Find(i)] = false;
  }
  return is_piece;
}

// Finds patches that may be near another without looking at all.
class PatchFinder {
 public:
  PatchFinder(const PatchGraph& graph, const std::vector<bool>& is_offered) : graph_(graph) {
    for (std::uint32_t i = 0; i < is_offered.size(); ++i) {
      if (!is_offered[i]) continue;
      patches_.push_back({graph.patches[i].centroid.x(), MaxReachOf(graph.patches[i]), i});
      max_reach_ = std::max(max_reach_, patches_.back().reach);
    }
    std::sort(patches_.begin(), patches_.end(), [](const Entry& a, const Entry& b) {
      return std::pair(a.x, a.patch) < std::pair(b.x, b.patch);
    });
  }

  // Calls visit(patch) for all of which a place may be within `gap` of one of the patch.
  template <typename Visitor>
  void Visit(std::uint32_t patch, double gap, const Visitor& visit) const {
    const Eigen::Vector3d& centroid = graph_.patches[patch].centroid;
    const double reach = MaxReachOf(graph_.patches[patch]) + gap;
    const double limit = reach + max_reach_;
    auto next = std::lower_bound(patches_.begin(), patches_.end(), centroid.x() - limit,
                                 [](const Entry& entry, double x) { return entry.x < x; });
    for (; next != patches_.end() && next->x <= centroid.x() + limit; ++next) {
      const double distance = (graph_.patches[next->patch].centroid - centroid).norm();
      if (distance <= reach + next->reach) visit(next->patch);
    }
  }

 private:
  struct Entry {
    double x = 0;
    double reach = 0;
    std::uint32_t patch = 0;
  };

  const PatchGraph& graph_;
  std::vector<Entry> patches_;  // By x.
  double max_reach_ = 0;
};

// Joins fragments, lists of patches, to what is near.
class FragmentJoiner {
 public:
  // `is_thing`: by patch, whether fragments may join it.
  FragmentJoiner(const PartsOfScene& scene,
                 const std::vector<bool>& is_thing,
                 double max_gap,
                 DisjointSets& sets)
      : scene_(scene), things_(scene.graph, is_thing), max_gap_(max_gap), sets_(sets) {}

  // All at once, so that their order has no effect. Returns whether any joined.
  bool Join(const std::vector<std::vector<std::uint32_t>>& fragments) {
    std::vector<std::vector<std::uint32_t>> near_of;
    for (const auto& fragment : fragments) near_of.push_back(FindNear(fragment));
    CollectPlaces(fragments, near_of);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> joins;
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      const std::uint32_t nearest = FindNearest(fragments[i], near_of[i]);
      if (nearest != kNothing) joins.emplace_back(fragments[i].front(), nearest);
    }
    for (const auto& [a, b] : joins) sets_.Join(a, b);
    return !joins.empty();
  }

 private:
  // Patches of other things of which a place may be near one of the fragment; ascending.
  std::vector<std::uint32_t> FindNear(const std::vector<std::uint32_t>& fragment) {
    std::set<std::uint32_t> near;
    for (const std::uint32_t patch : fragment) {
      things_.Visit(patch, max_gap_, [&](std::uint32_t other) {
        if (sets_.Find(other) != sets_.Find(patch)) near.insert(other);
      });
    }
    return {near.begin(), near.end()};
  }

  // Of the patches that are looked at, no others: there are many voxels.
  void CollectPlaces(const std::vector<std::vector<std::uint32_t>>& fragments,
                     const std::vector<std::vector<std::uint32_t>>& near_of) {
    std::vector<bool> is_used(scene_.graph.patches.size(), false);
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      if (near_of[i].empty()) continue;
      for (const std::uint32_t patch : fragments[i]) is_used[patch] = true;
      for (const std::uint32_t patch : near_of[i]) is_used[patch] = true;
    }
    places_of_.assign(is_used.size(), {});
    const auto& [places, patch_of_place] = scene_.places;
    for (std::size_t i = 0; i < patch_of_place.size(); ++i) {
      const std::uint32_t patch = patch_of_place[i];
      if (patch != kNoPatch && is_used[patch]) places_of_[patch].push_back(places[i]);
    }
    for (std::size_t patch = 0; patch < is_used.size(); ++patch) {
      if (!is_used[patch] || !places_of_[patch].empty()) continue;
      places_of_[patch].push_back(scene_.graph.patches[patch].centroid.cast<float>());
    }
    balls_.assign(is_used.size(), {});
    for (std::size_t patch = 0; patch < is_used.size(); ++patch) {
      Ball& ball = balls_[patch];
      ball.centre = scene_.graph.patches[patch].centroid.cast<float>();
      for (const Eigen::Vector3f& place : places_of_[patch]) {
        ball.radius = std::max(ball.radius, (place - ball.centre).norm());
      }
    }
  }

  // The least distance of places of two patches if it is below `limit`, else `limit`.
  float GapBetween(std::uint32_t a, std::uint32_t b, float limit) const {
    const Ball& ball = balls_[b];
    if ((balls_[a].centre - ball.centre).norm() - balls_[a].radius - ball.radius >= limit) {
      return limit;
    }
    for (const Eigen::Vector3f& here : places_of_[a]) {
      if ((here - ball.centre).norm() - ball.radius >= limit) continue;
      float least = limit * limit;
      for (const Eigen::Vector3f& there : places_of_[b]) {
        least = std::min(least, (here - there).squaredNorm());
      }
      limit = std::min(limit, std::sqrt(least));
    }
    return limit;
  }

  // Of equally near ones the first.
  std::uint32_t FindNearest(const std::vector<std::uint32_t>& fragment,
                            const std::vector<std::uint32_t>& near) {
    std::uint32_t nearest = kNothing;
    auto least = static_cast<float>(max_gap_);
    for (const std::uint32_t other : near) {
      for (const std::uint32_t patch : fragment) {
        const float gap = GapBetween(patch, other, least);
        if (gap >= least) continue;
        least = gap;
        nearest = other;
      }
    }
    return nearest;
  }

  // Around all places of a patch.
  struct Ball {
    Eigen::Vector3f centre = Eigen::Vector3f::Zero();
    float radius = 0;
  };

  const PartsOfScene& scene_;
  PatchFinder things_;
  double max_gap_;
  DisjointSets& sets_;
  std::vector<std::vector<Eigen::Vector3f>> places_of_;  // By patch, of those looked at.
  std::vector<Ball> balls_;
};

// A component as a body: where its mass is and what holds it.
struct Body {
  PointMoments moments;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // These two of the moments.
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  double area = 0;          // Square metres.
  double num_contacts = 0;  // With all others.
  // Of the surfaces that it stands on: normals, weighted by contacts. Zero if it stands on none.
  Eigen::Vector3d up = Eigen::Vector3d::Zero();

  bool Stands() const { return !up.isZero(); }
  // A contact that is short against the body holds nothing.
  bool Floats() const { return !Stands() && num_contacts * num_contacts <= moments.weight; }
};

// Of all that is not structural, by representative.
std::map<std::uint32_t, Body> FindBodies(const PartsOfScene& scene, DisjointSets& sets) {
  std::map<std::uint32_t, Body> bodies;
  const std::vector<Patch>& patches = scene.graph.patches;
  for (std::uint32_t i = 0; i < patches.size(); ++i) {
    const std::uint32_t body = sets.Find(i);
    if (scene.is_structural[body]) continue;
    bodies[body].moments += patches[i].moments;
    bodies[body].area += patches[i].area;
  }
  for (const PatchEdge& edge : scene.graph.edges) {
    const std::uint32_t a = sets.Find(edge.a);
    const std::uint32_t b = sets.Find(edge.b);
    if (a == b) continue;
    for (const auto& [part, other, patch] : {std::tuple(a, b, edge.b), std::tuple(b, a, edge.a)}) {
      if (scene.is_structural[part]) continue;
      bodies[part].num_contacts += edge.num_contacts;
      if (scene.is_structural[other]) bodies[part].up += edge.num_contacts * patches[patch].normal;
    }
  }
  for (auto& [representative, body] : bodies) {
    body.centre = body.moments.Mean();
    body.spread = body.moments.Covariance();
    body.up.normalize();
  }
  return bodies;
}

// Deviation of an even bar or disc whose end is at one, about: ends are at twice the deviation.
constexpr double kReach = 2;

// The height of the gap between a floating part and what stands beneath its centre; nothing if that
// does not, or if the gap is higher than the part.
std::optional<double> GapBeneath(const Body& part, const Body& support) {
  const Eigen::Vector3d& up = support.up;
  const Eigen::Vector3d offset = part.centre - support.centre;
  const double height = offset.dot(up);
  const Eigen::Matrix3d& spread = support.spread;
  const double top = kReach * std::sqrt(std::max(0.0, up.dot(spread * up)));
  const double half = kReach * std::sqrt(std::max(0.0, up.dot(part.spread * up)));
  if (height < top || height - top - half > 2 * half) return std::nullopt;
  // How far from the middle of the support, in its deviations. A narrow support has some width.
  constexpr double kMinDeviation = 0.004;  // Metres.
  const Eigen::Matrix3d along = Eigen::Matrix3d::Identity() - up * up.transpose();
  const Eigen::Matrix3d footprint =
      along * spread * along + up * up.transpose() + kMinDeviation * kMinDeviation * along;
  const Eigen::Vector3d aside = offset - height * up;
  if (aside.dot(footprint.inverse() * aside) > kReach * kReach) return std::nullopt;
  return height - top - half;
}

// Among what is as large as a thing, and no larger.
void JoinWhatStandsBeneath(const PartsOfScene& scene,
                           const ComponentOptions& options,
                           DisjointSets& sets) {
  std::map<std::uint32_t, Body> bodies = FindBodies(scene, sets);
  std::erase_if(bodies, [&](const auto& item) {
    return item.second.area < options.min_thing_area ||
           item.second.area >= options.min_structural_area;
  });
  for (const auto& [part, body] : bodies) {
    if (!body.Floats()) continue;
    std::uint32_t best = kNothing;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [other, support] : bodies) {
      if (!support.Stands()) continue;
      const std::optional<double> gap = GapBeneath(body, support);
      if (!gap || *gap >= least) continue;
      least = *gap;
      best = other;
    }
    if (best != kNothing) sets.Join(part, best);
  }
}

// What touches nothing and is too small to be a thing joins what is near. Returns whether any did.
bool JoinFragmentsToWhatIsNear(const PartsOfScene& scene,
                               const ComponentOptions& options,
                               DisjointSets& sets) {
  const std::vector<double> areas = AreasOf(scene.graph, sets);
  const std::vector<bool> is_untouched = FindUntouched(scene.graph, sets);
  const std::vector<bool> is_piece = FindPiecesOfSurfaces(scene, is_untouched, sets);
  std::vector<bool> is_thing;
  std::map<std::uint32_t, std::vector<std::uint32_t>> patches_of;
  for (std::uint32_t i = 0; i < areas.size(); ++i) {
    const std::uint32_t part = sets.Find(i);
    is_thing.push_back(!scene.is_structural[part] && !is_piece[part]);
    if (!is_thing[i] || !is_untouched[part] || areas[part] >= options.min_thing_area) continue;
    patches_of[part].push_back(i);
  }
  std::vector<std::vector<std::uint32_t>> fragments;
  for (auto& [part, patches] : patches_of) fragments.push_back(std::move(patches));
  if (fragments.empty()) return false;
  return FragmentJoiner(scene, is_thing, options.max_part_gap, sets).Join(fragments);
}

}  // namespace

void JoinFloatingParts(const PartsOfScene& scene,
                       const ComponentOptions& options,
                       DisjointSets& sets) {
  // Two fragments that joined may still be one.
  while (JoinFragmentsToWhatIsNear(scene, options, sets)) {
  }
  JoinWhatStandsBeneath(scene, options, sets);
}

}  // namespace semslam

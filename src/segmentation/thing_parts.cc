// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/thing_parts.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace semslam {
namespace {

constexpr std::uint32_t kNothing = std::numeric_limits<std::uint32_t>::max();

constexpr double kMinCosineOfFace = 0.94;  // Between normals of one face: 20 degrees.

// What a part shares with the neighbour it shares most with.
struct Attachment {
  std::uint32_t neighbour = kNothing;
  std::uint32_t num_contacts = 0;

  void Offer(std::uint32_t other, std::uint32_t contacts) {
    if (contacts <= num_contacts) return;  // Of equals the first.
    neighbour = other;
    num_contacts = contacts;
  }
};

// Of those pairs that `may_join`, a part and what it may join, the part's best. All of a round join
// at once, so that their order has no effect.
template <typename MayJoin>
std::map<std::uint32_t, Attachment> FindAttachments(const Contacts& contacts,
                                                    const MayJoin& may_join) {
  std::map<std::uint32_t, Attachment> attachments;
  for (const auto& [pair, num_contacts] : contacts) {
    const auto [a, b] = pair;
    if (may_join(a, b)) attachments[a].Offer(b, num_contacts);
    if (may_join(b, a)) attachments[b].Offer(a, num_contacts);
  }
  return attachments;
}

void JoinFragments(const PatchGraph& graph,
                   const std::vector<bool>& is_structural,
                   double min_area,
                   DisjointSets& sets) {
  for (bool has_changed = true; has_changed;) {
    const std::vector<double> areas = AreasOf(graph, sets);
    const auto attachments =
        FindAttachments(ContactsBetween(graph, sets), [&](std::uint32_t part, std::uint32_t other) {
          return !is_structural[part] && !is_structural[other] && areas[part] < min_area;
        });
    for (const auto& [part, attachment] : attachments) sets.Join(part, attachment.neighbour);
    has_changed = !attachments.empty();
  }
}

// The area that faces about the same way as patch `as`.
double AreaFacing(const std::vector<const Patch*>& patches, const Patch& as) {
  double area = 0;
  for (const Patch* patch : patches) {
    if (patch->normal.dot(as.normal) >= kMinCosineOfFace) area += patch->area;
  }
  return area;
}

// Whether its surface faces more ways than the three that are seen of a box.
bool IsRounded(std::vector<const Patch*> patches) {
  constexpr int kFaces = 3;
  constexpr double kMaxFlatShare = 0.8;
  double total = 0;
  for (const Patch* patch : patches) total += patch->area;
  double left = total;
  for (int face = 0; face < kFaces && !patches.empty(); ++face) {
    const Patch* best = nullptr;
    double largest = 0;
    for (const Patch* patch : patches) {
      const double area = AreaFacing(patches, *patch);
      if (area <= largest) continue;
      largest = area;
      best = patch;
    }
    if (best == nullptr) break;
    left -= largest;
    std::erase_if(patches, [&, normal = best->normal](const Patch* patch) {
      return patch->normal.dot(normal) >= kMinCosineOfFace;
    });
  }
  return left > (1 - kMaxFlatShare) * total;
}

// By representative: things, no larger than a table, that are no boxes.
std::vector<bool> FindRounded(const PatchGraph& graph,
                              const std::vector<double>& areas,
                              const ComponentOptions& options,
                              DisjointSets& sets) {
  std::map<std::uint32_t, std::vector<const Patch*>> patches_of;
  for (std::uint32_t i = 0; i < graph.patches.size(); ++i) {
    const std::uint32_t thing = sets.Find(i);
    if (areas[thing] < options.min_structural_area) patches_of[thing].push_back(&graph.patches[i]);
  }
  std::vector<bool> is_rounded(graph.patches.size(), false);
  for (auto& [thing, patches] : patches_of) is_rounded[thing] = IsRounded(std::move(patches));
  return is_rounded;
}

void JoinWhatRestsOnRoundedThings(const PatchGraph& graph,
                                  const std::vector<bool>& is_structural,
                                  const ComponentOptions& options,
                                  DisjointSets& sets) {
  for (bool has_changed = true; has_changed;) {
    const std::vector<double> areas = AreasOf(graph, sets);
    const std::vector<bool> is_rounded = FindRounded(graph, areas, options, sets);
    const Contacts contacts = ContactsBetween(graph, sets);
    std::map<std::uint32_t, std::uint32_t> num_contacts_of;
    for (const auto& [pair, num_contacts] : contacts) {
      num_contacts_of[pair.first] += num_contacts;
      num_contacts_of[pair.second] += num_contacts;
    }
    has_changed = false;
    for (const auto& [part, attachment] :
         FindAttachments(contacts, [&](std::uint32_t part, std::uint32_t other) {
           return !is_structural[part] && !is_structural[other] && is_rounded[other] &&
                  areas[part] < areas[other];
         })) {
      if (attachment.num_contacts < options.min_resting_share * num_contacts_of.at(part)) continue;
      sets.Join(part, attachment.neighbour);
      has_changed = true;
    }
  }
}

}  // namespace

Contacts ContactsBetween(const PatchGraph& graph, DisjointSets& sets) {
  Contacts contacts;
  for (const PatchEdge& edge : graph.edges) {
    const std::uint32_t a = sets.Find(edge.a);
    const std::uint32_t b = sets.Find(edge.b);
    if (a != b) contacts[std::minmax(a, b)] += edge.num_contacts;
  }
  return contacts;
}

std::vector<double> AreasOf(const PatchGraph& graph, DisjointSets& sets) {
  std::vector<double> areas(graph.patches.size(), 0.0);
  for (std::uint32_t i = 0; i < areas.size(); ++i) areas[sets.Find(i)] += graph.patches[i].area;
  return areas;
}

void JoinThingParts(const PatchGraph& graph,
                    const std::vector<bool>& is_structural,
                    const ComponentOptions& options,
                    DisjointSets& sets) {
  JoinFragments(graph, is_structural, options.min_thing_area, sets);
  JoinWhatRestsOnRoundedThings(graph, is_structural, options, sets);
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/split_segments.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "semantics/box_claims.h"
#include "semantics/evenly_chosen.h"
#include "semantics/segment_parts.h"

namespace semslam {
namespace {

constexpr std::uint32_t kMinKeyframes = 2;  // In which boxes part a segment.
constexpr double kMinShareOfKeyframes = 1.0 / 3.0;
constexpr double kMinShareOfPoints = 0.1;  // Of a segment, for either part.

// All that boxes say about one segment.
struct Claims {
  std::vector<BoxClaim> all;
  std::vector<std::pair<std::size_t, std::size_t>> rivals;
};

std::set<SegmentId> FindMixed(const Evidence& evidence) {
  std::set<SegmentId> mixed;
  for (std::size_t i = 0; i < evidence.segments.size(); ++i) {
    const SegmentEvidence& sums = evidence.segments[i];
    if (sums.num_parted >= kMinKeyframes &&
        sums.num_parted >= kMinShareOfKeyframes * sums.num_seen) {
      mixed.insert(static_cast<SegmentId>(i + 1));
    }
  }
  return mixed;
}

void AddClaims(const SeenKeyframe& keyframe,
               const KeyframeView& view,
               const Segmentation& segmentation,
               const ClassTable& classes,
               const EvidenceOptions& options,
               std::map<SegmentId, Claims>* claims_of) {
  std::vector<bool> is_asked(view.visibility.size(), false);
  for (const auto& [segment, claims] : *claims_of) is_asked[segment] = true;
  std::vector<BoxClaim> claims;
  for (const Detection& detection : keyframe.detections) {
    const CellRange range =
        CellRange::Of(detection.box, keyframe.cloud->stride(), view.image.columns, view.image.rows);
    const auto foreground =
        FindForeground(*keyframe.cloud, view.image, range,
                       FindBarriers(segmentation, classes, detection.class_id), options);
    for (BoxClaim& claim : ClaimsOf(foreground, keyframe, view, is_asked, options.min_pixels)) {
      claims.push_back(std::move(claim));
    }
  }
  // Where each claim goes among those on its segment.
  std::vector<std::size_t> place;
  const auto rivals = FindRivals(claims, view);
  for (BoxClaim& claim : claims) {
    std::vector<BoxClaim>& all = (*claims_of)[claim.segment].all;
    place.push_back(all.size());
    all.push_back(claim);
  }
  for (const auto& [a, b] : rivals) {
    (*claims_of)[claims[a].segment].rivals.emplace_back(place[a], place[b]);
  }
}

// Into an order that does not depend on that of keyframes and boxes.
void Sort(Claims* claims) {
  std::vector<std::size_t> order(claims->all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return claims->all[a].points < claims->all[b].points;
  });
  std::vector<BoxClaim> sorted;
  std::vector<std::size_t> place(order.size());
  for (const std::size_t claim : order) {
    place[claim] = sorted.size();
    sorted.push_back(std::move(claims->all[claim]));
  }
  claims->all = std::move(sorted);
  for (auto& [a, b] : claims->rivals) {
    std::tie(a, b) = std::pair(std::min(place[a], place[b]), std::max(place[a], place[b]));
  }
  std::sort(claims->rivals.begin(), claims->rivals.end());
}

// Which of two parts each point of a segment goes to.
class Parting {
 public:
  explicit Parting(const Claims& claims) : claims_(claims), is_used_(claims.all.size(), false) {}

  // The points of either part, ascending. `points`: all of the segment, ascending.
  std::array<std::vector<std::uint32_t>, 2> Part(const std::vector<std::uint32_t>& points,
                                                 const MapCloud& cloud) {
    const auto& [first, second] = ClearestRivals();
    Use(first, 0);
    Use(second, 1);
    while (UseWhatOverlaps()) {
    }
    std::array<std::vector<std::uint32_t>, 2> parts;
    std::vector<std::uint32_t> open;
    for (const std::uint32_t point : points) {
      const int side = SideOf(point);
      if (side < 0) {
        open.push_back(point);
      } else {
        parts[static_cast<std::size_t>(side)].push_back(point);
      }
    }
    GiveToTheNearest(open, cloud, &parts);
    for (auto& part : parts) std::sort(part.begin(), part.end());
    return parts;
  }

 private:
  std::pair<std::size_t, std::size_t> ClearestRivals() const {
    const auto smaller = [&](const std::pair<std::size_t, std::size_t>& pair) {
      return std::min(claims_.all[pair.first].points.size(),
                      claims_.all[pair.second].points.size());
    };
    return *std::max_element(claims_.rivals.begin(), claims_.rivals.end(),
                             [&](const auto& a, const auto& b) { return smaller(a) < smaller(b); });
  }

  void Use(std::size_t claim, std::size_t side) {
    is_used_[claim] = true;
    for (const std::uint32_t point : claims_.all[claim].points) ++votes_[point][side];
  }

  // -1: nothing speaks for either more than for the other.
  int SideOf(std::uint32_t point) const {
    const auto found = votes_.find(point);
    if (found == votes_.end() || found->second[0] == found->second[1]) return -1;
    return found->second[0] > found->second[1] ? 0 : 1;
  }

  // Claims that are clearly about one of the parts as known so far. False if there are none.
  bool UseWhatOverlaps() {
    constexpr double kMinKnown = 0.2;  // Of a claim's points.
    bool used_any = false;
    for (std::size_t i = 0; i < claims_.all.size(); ++i) {
      if (is_used_[i]) continue;
      std::array<std::size_t, 2> known{};
      for (const std::uint32_t point : claims_.all[i].points) {
        const int side = SideOf(point);
        if (side >= 0) ++known[static_cast<std::size_t>(side)];
      }
      const std::size_t more = known[0] >= known[1] ? 0 : 1;
      const auto size = static_cast<double>(claims_.all[i].points.size());
      if (static_cast<double>(known[more]) < kMinKnown * size) continue;
      if (known[more] < 2 * known[1 - more]) continue;
      Use(i, more);
      used_any = true;
    }
    return used_any;
  }

  static void GiveToTheNearest(const std::vector<std::uint32_t>& open,
                               const MapCloud& cloud,
                               std::array<std::vector<std::uint32_t>, 2>* parts) {
    constexpr std::size_t kMaxAsked = 500;  // Points of a part.
    std::array<std::vector<Eigen::Vector3f>, 2> asked;
    for (std::size_t side = 0; side < 2; ++side) {
      for (const std::uint32_t point : EvenlyChosen((*parts)[side], kMaxAsked)) {
        asked[side].push_back(cloud.positions[point]);
      }
    }
    for (const std::uint32_t point : open) {
      std::array<float, 2> distance{};
      for (std::size_t side = 0; side < 2; ++side) {
        distance[side] = std::numeric_limits<float>::infinity();
        for (const Eigen::Vector3f& other : asked[side]) {
          distance[side] = std::min(distance[side], (other - cloud.positions[point]).squaredNorm());
        }
      }
      (*parts)[distance[0] <= distance[1] ? 0 : 1].push_back(point);
    }
  }

  const Claims& claims_;
  std::vector<bool> is_used_;
  std::map<std::uint32_t, std::array<std::uint32_t, 2>> votes_;  // By point.
};

std::map<SegmentId, std::vector<std::uint32_t>> PointsOf(
    const std::map<SegmentId, Claims>& claims_of, const Segmentation& segmentation) {
  std::map<SegmentId, std::vector<std::uint32_t>> points_of;
  for (std::size_t i = 0; i < segmentation.segment_of_point.size(); ++i) {
    const SegmentId segment = segmentation.segment_of_point[i];
    if (claims_of.contains(segment)) points_of[segment].push_back(static_cast<std::uint32_t>(i));
  }
  return points_of;
}

}  // namespace

std::optional<Segmentation> SplitMixedSegments(const MapCloud& cloud,
                                               const Segmentation& segmentation,
                                               std::span<const SeenKeyframe> keyframes,
                                               const Evidence& evidence,
                                               const ClassTable& classes,
                                               const EvidenceOptions& options) {
  std::map<SegmentId, Claims> claims_of;
  for (const SegmentId segment : FindMixed(evidence)) claims_of[segment];
  if (claims_of.empty()) return std::nullopt;
  for (const SeenKeyframe& keyframe : keyframes) {
    const KeyframeView view = DrawSegments(keyframe, segmentation);
    AddClaims(keyframe, view, segmentation, classes, options, &claims_of);
  }
  for (auto& [segment, claims] : claims_of) Sort(&claims);
  std::optional<Segmentation> result;
  for (const auto& [segment, points] : PointsOf(claims_of, segmentation)) {
    auto parts = Parting(claims_of[segment]).Part(points, cloud);
    const std::size_t smaller = std::min(parts[0].size(), parts[1].size());
    if (static_cast<double>(smaller) < kMinShareOfPoints * static_cast<double>(points.size())) {
      continue;
    }
    if (!result) result = segmentation;
    const bool is_first_smaller = parts[0].size() < parts[1].size();
    MakeSegments(std::span(parts).subspan(is_first_smaller ? 0 : 1, 1), segment, cloud, &*result);
  }
  return result;
}

}  // namespace semslam

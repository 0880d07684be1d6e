// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/box_claims.h"

#include <algorithm>
#include <map>

namespace semslam {
namespace {

constexpr double kMaxCommon = 0.3;    // Share of the smaller claim.
constexpr double kMinTogether = 0.6;  // Share of what is seen of the segment.
constexpr double kMinEach = 0.15;

bool AreLargeEnough(double size_a, double size_b, std::uint32_t num_visible) {
  return std::min(size_a, size_b) >= kMinEach * num_visible &&
         size_a + size_b >= kMinTogether * num_visible;
}

bool AreRivals(const BoxClaim& a, const BoxClaim& b, std::uint32_t num_visible) {
  if (a.segment != b.segment) return false;
  const auto size_a = static_cast<double>(a.points.size());
  const auto size_b = static_cast<double>(b.points.size());
  if (!AreLargeEnough(size_a, size_b, num_visible)) return false;
  return static_cast<double>(CountCommon(a, b)) <= kMaxCommon * std::min(size_a, size_b);
}

}  // namespace

std::vector<BoxClaim> ClaimsOf(std::span<const std::size_t> foreground,
                               const SeenKeyframe& keyframe,
                               const KeyframeView& view,
                               const std::vector<bool>& is_asked,
                               std::uint32_t min_pixels) {
  std::map<SegmentId, std::vector<std::uint32_t>> points_of;
  for (const std::size_t cell : foreground) {
    const SegmentId segment = view.image.segments[cell];
    if (is_asked[segment]) points_of[segment].push_back(keyframe.points[cell]);
  }
  std::vector<BoxClaim> claims;
  for (auto& [segment, points] : points_of) {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() >= min_pixels) claims.push_back({segment, std::move(points)});
  }
  return claims;
}

std::size_t CountCommon(const BoxClaim& a, const BoxClaim& b) {
  std::size_t count = 0;
  auto other = b.points.begin();
  for (const std::uint32_t point : a.points) {
    while (other != b.points.end() && *other < point) ++other;
    if (other != b.points.end() && *other == point) ++count;
  }
  return count;
}

std::vector<std::pair<std::size_t, std::size_t>> FindRivals(std::span<const BoxClaim> claims,
                                                            const KeyframeView& view) {
  std::vector<std::pair<std::size_t, std::size_t>> rivals;
  for (std::size_t i = 0; i < claims.size(); ++i) {
    const std::uint32_t num_visible = view.visibility[claims[i].segment].num_pixels;
    for (std::size_t j = i + 1; j < claims.size(); ++j) {
      if (AreRivals(claims[i], claims[j], num_visible)) rivals.emplace_back(i, j);
    }
  }
  return rivals;
}

bool CanBeRivals(std::uint32_t num_cells_a, std::uint32_t num_cells_b, std::uint32_t num_visible) {
  return AreLargeEnough(num_cells_a, num_cells_b, num_visible);
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "semantics/keyframe_view.h"

namespace semslam {

// The part of a segment that is foreground of one box in one keyframe.
struct BoxClaim {
  SegmentId segment = 0;
  std::vector<std::uint32_t> points;  // Of the map's cloud, ascending.
};

// The claims of a box with this foreground (cells of the keyframe's grid) on the segments that
// `is_asked` tells, by segment. None of fewer than `min_pixels` points, for they tell nothing.
std::vector<BoxClaim> ClaimsOf(std::span<const std::size_t> foreground,
                               const SeenKeyframe& keyframe,
                               const KeyframeView& view,
                               const std::vector<bool>& is_asked,
                               std::uint32_t min_pixels);

// How many points two claims have in common.
std::size_t CountCommon(const BoxClaim& a, const BoxClaim& b);

// Pairs of one keyframe's claims that say that their segment is two things: they hardly overlap,
// and what is seen of the segment is mostly theirs. (A board with things on it is not.)
std::vector<std::pair<std::size_t, std::size_t>> FindRivals(std::span<const BoxClaim> claims,
                                                            const KeyframeView& view);

// Whether two claims on a segment can be rivals, by the most that they can be: their cells in the
// grid. This needs no claims, and mostly tells.
bool CanBeRivals(std::uint32_t num_cells_a, std::uint32_t num_cells_b, std::uint32_t num_visible);

}  // namespace semslam

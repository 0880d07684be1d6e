// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <compare>
#include <cstdint>

namespace semslam {

// Two positions relative to the keypoint, in pixels of its pyramid level, before they are turned
// by the keypoint's angle. A descriptor's bit is set if the first one is darker than the second.
struct BriefPair {
  std::int8_t first_x, first_y, second_x, second_y;
  friend auto operator<=>(const BriefPair&, const BriefPair&) = default;
};

// The pairs of ORB's 256 bits, bit 0 of byte 0 first (Rublee et al., "ORB: an efficient
// alternative to SIFT or SURF", 2011).
const std::array<BriefPair, 256>& OrbPattern();

}  // namespace semslam

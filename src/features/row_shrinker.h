// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace semslam {

// Where a value lies between two neighbours: weight_next / kTapOne of the way from the one at
// `index` to the next.
struct Tap {
  std::int32_t index;
  std::int16_t weight;
  std::int16_t weight_next;
};
inline constexpr int kTapBits = 7;  // A pixel times a weight then fits 16 bits with a sign.
inline constexpr int kTapOne = 1 << kTapBits;

// For every i < size the position i * ratio of `source_size` (>= 2) values.
std::vector<Tap> MakeTaps(int size, int source_size, double ratio);

// Makes rows of an image shorter by linear interpolation: value x of the result is the source's at
// x * ratio, times kTapOne.
class RowShrinker {
 public:
  // 1 <= ratio <= 2.
  RowShrinker(int width, int source_width, double ratio);

  // `row` has source_width pixels, `out` room for `width` values.
  void Shrink(const std::uint8_t* row, std::int16_t* out) const;

 private:
  // Eight values of the result, whose sources lie in sixteen neighbouring pixels.
  struct Group {
    std::int32_t first = 0;                     // Of the pixels.
    std::array<std::uint8_t, 16> neighbours{};  // Two for each value, relative to `first`.
    std::array<std::uint8_t, 16> weights{};     // Of these.
  };

  void ShrinkGroups(const std::uint8_t* row, std::int16_t* out) const;

  std::vector<Tap> taps_;
  std::vector<Group> groups_;  // Of the values up to the last that a group can serve; or none.
};

}  // namespace semslam

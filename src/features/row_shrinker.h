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

// Values between pixels are pixels times this.
inline constexpr int kRowOne = 2 * kTapOne;

// Makes rows of an image shorter by linear interpolation: value x of the result is the source's at
// x * ratio, times kRowOne.
class RowShrinker {
 public:
  // 1 <= ratio <= 2. Past the end of the source its last pixel is repeated.
  RowShrinker(int width, int source_width, double ratio);

  // `row` has source_width pixels, `out` room for `width` values.
  void Shrink(const std::uint8_t* row, std::uint16_t* out) const;

 private:
  using Bytes = std::array<std::uint8_t, 16>;

  int num_groups() const { return static_cast<int>(first_pixels_.size()); }
  int ShrinkPairsOfGroups(const std::uint8_t* row, std::uint16_t* out) const;
  void ShrinkGroups(int begin, const std::uint8_t* row, std::uint16_t* out) const;

  std::vector<Tap> taps_;
  // Groups of eight values, whose sources lie in sixteen neighbouring pixels. None if the source is
  // shorter or the processor cannot do them.
  std::vector<std::int32_t> first_pixels_;
  std::vector<Bytes> neighbours_;  // Two for each value, relative to the first pixel.
  std::vector<Bytes> weights_;     // Of these.
};

}  // namespace semslam

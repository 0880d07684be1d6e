// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/fast.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

#include <opencv2/core.hpp>

#include "semslam/base/check.h"

#include "features/simd_clones.h"

namespace semslam {
namespace {

// Pixels side by side, worked on at once: GCC and Clang make vector instructions of it, of AVX2,
// SSE2 or NEON.
constexpr int kBlock = 32;
using Pixels = std::uint8_t __attribute__((vector_size(kBlock)));

constexpr int kCircle = 16;
constexpr int kArc = 9;

SEMSLAM_SIMD_INLINE Pixels Load(const std::uint8_t* first) {
  Pixels pixels;
  std::memcpy(&pixels, first, kBlock);
  return pixels;
}
SEMSLAM_SIMD_INLINE Pixels All(int value) { return Pixels{} + static_cast<std::uint8_t>(value); }
SEMSLAM_SIMD_INLINE Pixels Min(Pixels a, Pixels b) { return a < b ? a : b; }
SEMSLAM_SIMD_INLINE Pixels Max(Pixels a, Pixels b) { return a > b ? a : b; }
// a - b, or 0 where that is negative.
SEMSLAM_SIMD_INLINE Pixels Excess(Pixels a, Pixels b) { return Max(a, b) - b; }

constexpr int kWordPixels = 8;
constexpr int kNumWords = kBlock / kWordPixels;
using Words = std::array<std::uint64_t, kNumWords>;
SEMSLAM_SIMD_INLINE Words AsWords(Pixels pixels) {
  Words words;
  std::memcpy(words.data(), &pixels, kBlock);
  return words;
}
SEMSLAM_SIMD_INLINE bool IsAnySet(Pixels pixels) {
  const Words words = AsWords(pixels);
  return (words[0] | words[1] | words[2] | words[3]) != 0;
}

// Offsets of the circle's pixels from its centre, clockwise from the top.
std::array<std::ptrdiff_t, kCircle> CircleOffsets(std::ptrdiff_t step) {
  constexpr std::array<int, kCircle> kX = {0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3, -3, -3, -2, -1};
  constexpr std::array<int, kCircle> kY = {-3, -3, -2, -1, 0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3};
  std::array<std::ptrdiff_t, kCircle> offsets{};
  for (int i = 0; i < kCircle; ++i) offsets[i] = kY[i] * step + kX[i];
  return offsets;
}

// Of every arc of nine, the smallest excess; of those, the largest. By doubling: the least of two
// in a row, of four, of eight, of nine.
SEMSLAM_SIMD_INLINE Pixels StrongestArc(const std::array<Pixels, kCircle>& excess) {
  static_assert(kArc == 9);
  std::array<Pixels, kCircle> two;
  std::array<Pixels, kCircle> four;
  for (int i = 0; i < kCircle; ++i) two[i] = Min(excess[i], excess[(i + 1) % kCircle]);
  for (int i = 0; i < kCircle; ++i) four[i] = Min(two[i], two[(i + 2) % kCircle]);
  Pixels strongest{};
  for (int i = 0; i < kCircle; ++i) {
    const Pixels eight = Min(four[i], four[(i + 4) % kCircle]);
    strongest = Max(strongest, Min(eight, excess[(i + 8) % kCircle]));
  }
  return strongest;
}

// Every arc of nine holds two neighbours of these four: top, right, bottom, left.
SEMSLAM_SIMD_INLINE Pixels StrongestQuarter(const std::array<Pixels, 4>& excess) {
  return Max(Max(Min(excess[0], excess[1]), Min(excess[1], excess[2])),
             Max(Min(excess[2], excess[3]), Min(excess[3], excess[0])));
}

// The scores of a block of pixels, 0 for those that are no corners.
SEMSLAM_SIMD_INLINE Pixels ScoreBlock(const std::uint8_t* center,
                                      const std::array<std::ptrdiff_t, kCircle>& offsets,
                                      Pixels threshold) {
  const Pixels middle = Load(center);
  std::array<Pixels, 4> brighter;
  std::array<Pixels, 4> darker;
  for (int i = 0; i < 4; ++i) {
    const Pixels pixels = Load(center + offsets[4 * i]);
    brighter[i] = Excess(pixels, middle);
    darker[i] = Excess(middle, pixels);
  }
  Pixels score{};
  std::array<Pixels, kCircle> excess;
  if (IsAnySet(Excess(StrongestQuarter(brighter), threshold))) {
    for (int i = 0; i < kCircle; ++i) excess[i] = Excess(Load(center + offsets[i]), middle);
    score = StrongestArc(excess);
  }
  if (IsAnySet(Excess(StrongestQuarter(darker), threshold))) {
    for (int i = 0; i < kCircle; ++i) excess[i] = Excess(middle, Load(center + offsets[i]));
    score = Max(score, StrongestArc(excess));
  }
  // A corner at every threshold below the score.
  const Pixels is_corner = score > threshold ? All(255) : All(0);
  return (score - 1) & is_corner;
}

// Scores of a row of an area, and zeros on either side.
class ScoreRow {
 public:
  explicit ScoreRow(int width) : width_(width), scores_(1 + width + kBlock, 0) {}
  void Clear() { std::fill(scores_.begin(), scores_.end(), std::uint8_t{0}); }
  // From the row's first pixel on; at least a block can be read there.
  SEMSLAM_SIMD_INLINE void Fill(const std::uint8_t* row,
                                const std::array<std::ptrdiff_t, kCircle>& offsets,
                                Pixels threshold) {
    const int last = std::max(width_ - kBlock, 0);
    for (int x = 0; x < width_; x += kBlock) {
      const int first = std::min(x, last);  // The last block overlaps the one before.
      const Pixels scores = ScoreBlock(row + first, offsets, threshold);
      std::memcpy(&scores_[first + 1], &scores, kBlock);
    }
    if (width_ < kBlock) std::fill(scores_.begin() + width_ + 1, scores_.end(), std::uint8_t{0});
  }
  // The block from pixel x on: -1 <= x <= width - 1.
  SEMSLAM_SIMD_INLINE Pixels Block(int x) const { return Load(&scores_[x + 1]); }
  SEMSLAM_SIMD_INLINE Pixels MostNear(int x) const {
    return Max(Max(Block(x - 1), Block(x)), BlockAfter(x));
  }
  SEMSLAM_SIMD_INLINE Pixels BlockAfter(int x) const { return Load(&scores_[x + 2]); }

 private:
  int width_;
  std::vector<std::uint8_t> scores_;
};

// The corners of a row that are stronger than all their neighbours.
SEMSLAM_SIMD_INLINE void AppendStrongest(const ScoreRow& above,
                                         const ScoreRow& row,
                                         const ScoreRow& below,
                                         const cv::Rect& area,
                                         int y,
                                         std::vector<Corner>& corners) {
  constexpr int kBitsPerPixel = 8;
  for (int x = 0; x < area.width; x += kBlock) {
    const Pixels scores = row.Block(x);
    if (!IsAnySet(scores)) continue;
    const Pixels beside = Max(row.Block(x - 1), row.BlockAfter(x));
    const Pixels around = Max(beside, Max(above.MostNear(x), below.MostNear(x)));
    const Words strongest = AsWords(scores > around ? scores : All(0));
    for (int word = 0; word < kNumWords; ++word) {
      for (std::uint64_t left = strongest[word]; left != 0;) {
        const int i = std::countr_zero(left) / kBitsPerPixel;
        const std::uint64_t score = left >> (i * kBitsPerPixel) & 255;
        left &= ~(std::uint64_t{255} << (i * kBitsPerPixel));
        corners.push_back({static_cast<std::int16_t>(area.x + x + word * kWordPixels + i),
                           static_cast<std::int16_t>(y), static_cast<float>(score)});
      }
    }
  }
}

// The area and its rim, so wide that a block fits in.
cv::Mat WithRim(const cv::Mat& image, const cv::Rect& area) {
  const cv::Rect rim(area.x - kFastRadius, area.y - kFastRadius, area.width + 2 * kFastRadius,
                     area.height + 2 * kFastRadius);
  if (area.width >= kBlock) return image(rim);
  cv::Mat wider(rim.height, kBlock + 2 * kFastRadius, CV_8UC1, cv::Scalar(0));
  image(rim).copyTo(wider.colRange(0, rim.width));
  return wider;
}

}  // namespace

SEMSLAM_SIMD_CLONES void AppendFastCorners(const cv::Mat& image,
                                           const cv::Rect& area,
                                           int threshold,
                                           std::vector<Corner>& corners) {
  SEMSLAM_CHECK(image.type() == CV_8UC1) << image.type();
  if (area.empty()) return;
  const cv::Mat source = WithRim(image, area);
  const auto offsets = CircleOffsets(static_cast<std::ptrdiff_t>(source.step));
  const Pixels thresholds = All(threshold);
  std::array<ScoreRow, 3> rows = {ScoreRow(area.width), ScoreRow(area.width), ScoreRow(area.width)};
  // Row y is filled, then the one above it is looked at.
  for (int y = 0; y <= area.height; ++y) {
    ScoreRow& below = rows[y % 3];
    if (y < area.height) {
      below.Fill(source.ptr<std::uint8_t>(y + kFastRadius) + kFastRadius, offsets, thresholds);
    } else {
      below.Clear();
    }
    if (y == 0) continue;
    AppendStrongest(rows[(y + 1) % 3], rows[(y + 2) % 3], below, area, area.y + y - 1, corners);
  }
}

}  // namespace semslam

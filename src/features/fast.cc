// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/fast.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <opencv2/core.hpp>

#include "semslam/base/check.h"
#include "semslam/base/simd_clones.h"

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

// One bit for each pixel of a comparison's result, the first one lowest.
SEMSLAM_SIMD_INLINE std::uint32_t AsBits(Pixels is_set) {
#if defined(__SSE2__)
  struct {
    __m128i low;
    __m128i high;
  } halves;
  std::memcpy(&halves, &is_set, kBlock);
  return static_cast<std::uint32_t>(_mm_movemask_epi8(halves.low)) |
         static_cast<std::uint32_t>(_mm_movemask_epi8(halves.high)) << 16;
#else
  std::array<std::uint64_t, 4> words;
  std::memcpy(words.data(), &is_set, kBlock);
  std::uint32_t bits = 0;
  for (int i = 0; i < 4; ++i) {
    // Of eight bytes 0 or 255 one bit each, moved to the highest byte.
    const std::uint64_t byte = (words[i] & 0x8040201008040201) * 0x0101010101010101 >> 56;
    bits |= static_cast<std::uint32_t>(byte) << (8 * i);
  }
  return bits;
#endif
}

// The circle's pixels around each of a block, clockwise from the top.
using Circle = std::array<Pixels, kCircle>;
SEMSLAM_SIMD_INLINE Circle LoadCircle(const std::uint8_t* center, std::ptrdiff_t step) {
  constexpr std::array<int, kCircle> kX = {0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3, -3, -3, -2, -1};
  constexpr std::array<int, kCircle> kY = {-3, -3, -2, -1, 0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3};
  Circle circle;
  for (int i = 0; i < kCircle; ++i) circle[i] = Load(center + kY[i] * step + kX[i]);
  return circle;
}

// Of two grey values the one nearer to, or farther from, a centre that is darker (or brighter) than
// both.
enum class Side { kBrighter, kDarker };
template <Side kSide>
SEMSLAM_SIMD_INLINE Pixels Near(Pixels a, Pixels b) {
  return kSide == Side::kBrighter ? Min(a, b) : Max(a, b);
}
template <Side kSide>
SEMSLAM_SIMD_INLINE Pixels Far(Pixels a, Pixels b) {
  return kSide == Side::kBrighter ? Max(a, b) : Min(a, b);
}

// Of every arc of nine the value nearest to the centre's; of those, the farthest. By doubling: the
// nearest of two in a row, of four, of eight; and two arcs of nine share the eight in their middle.
template <Side kSide>
SEMSLAM_SIMD_INLINE Pixels StrongestArc(const Circle& circle) {
  static_assert(kArc == 9);
  constexpr int kNumEights = kCircle / 2;  // They begin at pixels 1, 3, ... 15.
  std::array<Pixels, kNumEights> two;
  std::array<Pixels, kNumEights> four;
  std::array<Pixels, kNumEights> strongest;
  for (int i = 0; i < kNumEights; ++i) {
    two[i] = Near<kSide>(circle[2 * i + 1], circle[(2 * i + 2) % kCircle]);
  }
  for (int i = 0; i < kNumEights; ++i) four[i] = Near<kSide>(two[i], two[(i + 1) % kNumEights]);
  for (int i = 0; i < kNumEights; ++i) {
    const Pixels eight = Near<kSide>(four[i], four[(i + 2) % kNumEights]);
    const Pixels ninth = Far<kSide>(circle[2 * i], circle[(2 * i + kArc) % kCircle]);
    strongest[i] = Near<kSide>(eight, ninth);
  }
  for (int half = kNumEights / 2; half > 0; half /= 2) {
    for (int i = 0; i < half; ++i) {
      strongest[i] = Far<kSide>(strongest[i], strongest[i + half]);
    }
  }
  return strongest[0];
}

// The same of arcs of two of the pixels at the top, right, bottom and left: every arc of nine holds
// one of them.
template <Side kSide>
SEMSLAM_SIMD_INLINE Pixels StrongestQuarter(Pixels top, Pixels right, Pixels bottom, Pixels left) {
  return Near<kSide>(Far<kSide>(top, bottom), Far<kSide>(right, left));
}

// The scores of a block of pixels, 0 for those that are no corners.
SEMSLAM_SIMD_INLINE Pixels ScoreBlock(const std::uint8_t* center,
                                      std::ptrdiff_t step,
                                      Pixels threshold) {
  const Pixels middle = Load(center);
  const Pixels top = Load(center - 3 * step);
  const Pixels right = Load(center + 3);
  const Pixels bottom = Load(center + 3 * step);
  const Pixels left = Load(center - 3);
  const Pixels bound =
      Max(Excess(StrongestQuarter<Side::kBrighter>(top, right, bottom, left), middle),
          Excess(middle, StrongestQuarter<Side::kDarker>(top, right, bottom, left)));
  if (AsBits(bound > threshold ? All(255) : All(0)) == 0) return Pixels{};
  const Circle circle = LoadCircle(center, step);
  const Pixels score = Max(Excess(StrongestArc<Side::kBrighter>(circle), middle),
                           Excess(middle, StrongestArc<Side::kDarker>(circle)));
  // A corner at every threshold below the score.
  const Pixels is_corner = score > threshold ? All(255) : All(0);
  return (score - 1) & is_corner;
}

// The scores of `width` pixels in a row; at least a block can be read and written. `thresholds` are
// those of a block.
SEMSLAM_SIMD_CLONES void ScoreRow(const std::uint8_t* row,
                                  std::ptrdiff_t step,
                                  int width,
                                  const std::uint8_t* thresholds,
                                  std::uint8_t* scores) {
  const int last = std::max(width - kBlock, 0);
  for (int x = 0; x < width; x += kBlock) {
    const int first = std::min(x, last);  // The last block overlaps the one before.
    const Pixels block = ScoreBlock(row + first, step, Load(thresholds));
    std::memcpy(scores + first, &block, kBlock);
  }
}

// Scores of three neighbouring rows of an area, with zeros on either side.
class ScoreRows {
 public:
  explicit ScoreRows(int width)
      : width_(width), stride_(kBefore + width + kBlock), scores_(3 * stride_, 0) {}
  // The first pixel of row y, in place of row y - 3.
  std::uint8_t* Row(int y) { return scores_.data() + (y + 3) % 3 * stride_ + kBefore; }
  void Clear(int y) { std::fill_n(Row(y), width_, std::uint8_t{0}); }
  // Puts zeros after the row, where a block was written that is wider.
  void ClearAfter(int y) {
    if (width_ < kBlock) std::fill_n(Row(y) + width_, kBlock - width_, std::uint8_t{0});
  }

 private:
  static constexpr int kBefore = 1;
  int width_;
  std::ptrdiff_t stride_;
  std::vector<std::uint8_t> scores_;
};

SEMSLAM_SIMD_INLINE Pixels MostNear(const std::uint8_t* scores) {
  return Max(Max(Load(scores - 1), Load(scores)), Load(scores + 1));
}

// The corners of a row that are stronger than all their neighbours; `left` is its first pixel.
SEMSLAM_SIMD_CLONES void AppendStrongest(const std::uint8_t* above,
                                         const std::uint8_t* row,
                                         const std::uint8_t* below,
                                         int width,
                                         const cv::Point& left,
                                         std::vector<Corner>& corners) {
  for (int x = 0; x < width; x += kBlock) {
    const Pixels scores = Load(row + x);
    const Pixels beside = Max(Load(row + x - 1), Load(row + x + 1));
    const Pixels around = Max(beside, Max(MostNear(above + x), MostNear(below + x)));
    for (std::uint32_t rest = AsBits(scores > around ? All(255) : All(0)); rest != 0;) {
      const int i = x + std::countr_zero(rest);
      rest &= rest - 1;
      corners.push_back({static_cast<std::int16_t>(left.x + i), static_cast<std::int16_t>(left.y),
                         static_cast<float>(row[i])});
    }
  }
}

// The area and its rim, with room for a block.
cv::Mat WithRim(const cv::Mat& image, const cv::Rect& area) {
  const int width = std::max(area.width, kBlock) + 2 * kFastRadius;
  const cv::Rect rim(area.x - kFastRadius, area.y - kFastRadius, width,
                     area.height + 2 * kFastRadius);
  if (rim.x + width <= image.cols) return image(rim);
  cv::Mat wider(rim.height, width, CV_8UC1, cv::Scalar(0));
  const cv::Rect inside = rim & cv::Rect(0, 0, image.cols, image.rows);
  image(inside).copyTo(wider.colRange(0, inside.width));
  return wider;
}

}  // namespace

void AppendFastCorners(const cv::Mat& image,
                       const cv::Rect& area,
                       int threshold,
                       std::vector<Corner>& corners) {
  SEMSLAM_CHECK(image.type() == CV_8UC1) << image.type();
  if (area.empty()) return;
  const cv::Mat source = WithRim(image, area);
  const auto step = static_cast<std::ptrdiff_t>(source.step);
  ScoreRows rows(area.width);
  std::array<std::uint8_t, kBlock> thresholds;
  thresholds.fill(static_cast<std::uint8_t>(threshold));
  // Row y is filled, then the one above it is looked at.
  for (int y = 0; y <= area.height; ++y) {
    if (y < area.height) {
      ScoreRow(source.ptr<std::uint8_t>(y + kFastRadius) + kFastRadius, step, area.width,
               thresholds.data(), rows.Row(y));
      rows.ClearAfter(y);
    } else {
      rows.Clear(y);
    }
    if (y == 0) continue;
    AppendStrongest(rows.Row(y - 2), rows.Row(y - 1), rows.Row(y), area.width,
                    {area.x, area.y + y - 1}, corners);
  }
}

}  // namespace semslam

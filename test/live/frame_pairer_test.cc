// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "live/frame_pairer.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "semslam/base/random.h"

namespace semslam {
namespace {

constexpr std::int64_t kPeriod = 33'333;
constexpr auto kColor = StreamKind::kColor;
constexpr auto kDepth = StreamKind::kDepth;

StreamImage At(std::int64_t time_us) { return {.time_us = time_us, .image = {}}; }

TEST(FramePairer, ImagesOfTheSameTimeArePairedInEitherOrder) {
  FramePairer pairer(kPeriod / 2);
  EXPECT_FALSE(pairer.Add(kColor, At(100)));
  EXPECT_TRUE(pairer.Add(kDepth, At(100)));
  EXPECT_FALSE(pairer.Add(kDepth, At(200)));
  EXPECT_TRUE(pairer.Add(kColor, At(200)));
  EXPECT_EQ(pairer.num_unpaired(), 0u);
}

TEST(FramePairer, TheColorImageIsInItsPlace) {
  FramePairer pairer(kPeriod / 2);
  pairer.Add(kDepth, At(7));
  const auto pair = pairer.Add(kColor, At(9));
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->color.time_us, 9);
  EXPECT_EQ(pair->depth.time_us, 7);
}

TEST(FramePairer, AnImageWithoutAPartnerIsCountedAndTheNextIsPaired) {
  FramePairer pairer(kPeriod / 2);
  pairer.Add(kColor, At(0));
  EXPECT_FALSE(pairer.Add(kColor, At(kPeriod)));
  EXPECT_TRUE(pairer.Add(kDepth, At(kPeriod)));
  EXPECT_EQ(pairer.num_unpaired(), 1u);
}

TEST(FramePairer, OneThatComesTooLateLeavesTheNewerOneWaiting) {
  FramePairer pairer(kPeriod / 2);
  pairer.Add(kColor, At(kPeriod));
  EXPECT_FALSE(pairer.Add(kDepth, At(0)));
  EXPECT_TRUE(pairer.Add(kDepth, At(kPeriod + 10)));
  EXPECT_EQ(pairer.num_unpaired(), 1u);
}

TEST(FramePairer, AClockThatBeginsAnewIsFollowed) {
  FramePairer pairer(kPeriod / 2);
  pairer.Add(kColor, At(1'000'000));
  EXPECT_FALSE(pairer.Add(kColor, At(10)));
  EXPECT_TRUE(pairer.Add(kDepth, At(12)));
}

TEST(FramePairer, ResetForgetsWhatWaits) {
  FramePairer pairer(kPeriod / 2);
  pairer.Add(kColor, At(0));
  pairer.Reset();
  EXPECT_FALSE(pairer.Add(kDepth, At(0)));
  EXPECT_EQ(pairer.num_unpaired(), 1u);
}

// Streams that are not synchronised, with jitter and losses, against a search for the nearest.
TEST(FramePairer, PartnersAreTheNearestOnes) {
  for (const std::int64_t offset : {-16'000, -9'000, 0, 5'000, 16'000}) {
    Random random(static_cast<std::uint64_t>(offset + 20'000));
    std::vector<std::pair<std::int64_t, StreamKind>> images;
    std::vector<std::int64_t> depths;
    for (int i = 1; i < 300; ++i) {
      const std::int64_t jitter = static_cast<std::int64_t>(random.Uniform(-500, 500));
      if (random.Uniform() > 0.1) images.emplace_back(i * kPeriod, kColor);
      if (random.Uniform() > 0.1) {
        depths.push_back(i * kPeriod + offset + jitter);
        images.emplace_back(depths.back(), kDepth);
      }
    }
    std::sort(images.begin(), images.end());
    FramePairer pairer(kPeriod / 2);
    std::size_t num_pairs = 0;
    for (const auto& [time, kind] : images) {
      const auto pair = pairer.Add(kind, At(time));
      if (!pair) continue;
      ++num_pairs;
      const std::int64_t color = pair->color.time_us;
      const auto nearest =
          *std::min_element(depths.begin(), depths.end(), [color](std::int64_t a, std::int64_t b) {
            return std::abs(a - color) < std::abs(b - color);
          });
      EXPECT_EQ(pair->depth.time_us, nearest) << "offset " << offset;
    }
    EXPECT_GT(num_pairs, 200u) << "offset " << offset;
  }
}

}  // namespace
}  // namespace semslam

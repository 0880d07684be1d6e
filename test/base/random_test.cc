// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/base/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace semslam {
namespace {

constexpr int kNumSamples = 100'000;

TEST(Random, GivesThePublishedSequenceOfSplitMix64) {
  // The reference implementation's first values for this seed.
  Random random(1234567);
  EXPECT_EQ(random(), 6457827717110365317u);
  EXPECT_EQ(random(), 3203168211198807973u);
  EXPECT_EQ(random(), 9817491932198370423u);
}

TEST(Random, UniformFillsItsIntervalEvenly) {
  Random random(1);
  double sum = 0;
  double low = 1;
  double high = 0;
  for (int i = 0; i < kNumSamples; ++i) {
    const double value = random.Uniform();
    sum += value;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  EXPECT_GE(low, 0.0);
  EXPECT_LT(high, 1.0);
  EXPECT_LT(low, 1e-3);
  EXPECT_GT(high, 1 - 1e-3);
  EXPECT_NEAR(sum / kNumSamples, 0.5, 4 * std::sqrt(1.0 / 12 / kNumSamples));
}

TEST(Random, IndexReachesEveryValueEquallyOften) {
  Random random(2);
  std::array<int, 7> counts{};
  for (int i = 0; i < kNumSamples; ++i) ++counts.at(random.Index(7));
  double chi_squared = 0;
  constexpr double kExpected = kNumSamples / 7.0;
  for (const int count : counts)
    chi_squared += (count - kExpected) * (count - kExpected) / kExpected;
  EXPECT_LT(chi_squared, 22.5);  // 0.1 % quantile at 6 degrees of freedom.
}

TEST(Random, GaussianHasMeanZeroAndDeviationOne) {
  Random random(3);
  double sum = 0;
  double sum_squares = 0;
  int num_beyond_two = 0;
  for (int i = 0; i < kNumSamples; ++i) {
    const double value = random.Gaussian();
    ASSERT_TRUE(std::isfinite(value));
    sum += value;
    sum_squares += value * value;
    num_beyond_two += std::abs(value) > 2 ? 1 : 0;
  }
  EXPECT_NEAR(sum / kNumSamples, 0.0, 0.015);
  EXPECT_NEAR(sum_squares / kNumSamples, 1.0, 0.02);
  EXPECT_NEAR(static_cast<double>(num_beyond_two) / kNumSamples, 0.0455, 0.003);
}

TEST(Random, ServesTheStandardLibrarysAlgorithms) {
  std::vector<int> values{1, 2, 3, 4, 5, 6, 7, 8};
  std::shuffle(values.begin(), values.end(), Random(4));
  EXPECT_FALSE(std::is_sorted(values.begin(), values.end()));
}

}  // namespace
}  // namespace semslam

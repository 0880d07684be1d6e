// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/belief.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace semslam {
namespace {

using Sums = std::vector<std::int64_t>;

TEST(Belief, IsInProportionToTheEvidence) {
  const Sums alpha = {60, 20, 0};
  const Belief belief(alpha, 10, 10);
  EXPECT_EQ(belief.best_class(), 0);
  EXPECT_DOUBLE_EQ(belief.ProbabilityOf(0), 0.6);
  EXPECT_DOUBLE_EQ(belief.ProbabilityOf(2), 0);
  const double entropy =
      -(0.6 * std::log(0.6) + 0.2 * std::log(0.2) + 2 * 0.1 * std::log(0.1)) / std::log(5.0);
  EXPECT_DOUBLE_EQ(belief.Entropy(), entropy);
  EXPECT_EQ(belief.background_confidence(), 0);
}

TEST(Belief, IsUnknownWhileThereIsLittleEvidence) {
  const Sums alpha = {5, 4};
  const Belief belief(alpha, 5, 6);
  EXPECT_EQ(belief.best_class(), kNoClass);
  EXPECT_EQ(belief.background_confidence(), 0);
  EXPECT_NEAR(belief.Entropy(), 1, 0.02);
}

TEST(Belief, IsBackgroundWhereThatHasMost) {
  const Sums alpha = {8, 0};
  const Belief belief(alpha, 30, 2);
  EXPECT_EQ(belief.best_class(), kNoClass);
  EXPECT_DOUBLE_EQ(belief.background_confidence(), 0.75);
}

TEST(Belief, GivesTiesToNotKnowingAndToTheLowerClass) {
  const Sums alpha = {3, 7, 7};
  EXPECT_EQ(Belief(alpha, 0, 6).best_class(), 1);
  EXPECT_EQ(Belief(alpha, 7, 1).best_class(), kNoClass);
  EXPECT_EQ(Belief(alpha, 0, 7).best_class(), kNoClass);
}

TEST(Belief, BecomesSureWithEvidence) {
  double before = 1;
  for (const std::int64_t evidence : {10, 100, 1000, 10000}) {
    const Sums alpha = {0, evidence};
    const double entropy = Belief(alpha, 0, 1).Entropy();
    EXPECT_LT(entropy, before);
    before = entropy;
  }
  EXPECT_LT(before, 0.01);
}

}  // namespace
}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/features/descriptor.h"

#include <gtest/gtest.h>

#include "semslam/base/random.h"

namespace semslam {
namespace {

int CountBitByBit(const Descriptor& a, const Descriptor& b) {
  int count = 0;
  for (int i = 0; i < kDescriptorBits; ++i) {
    count += static_cast<int>(((a.bits[i / 64] ^ b.bits[i / 64]) >> (i % 64)) & 1);
  }
  return count;
}

TEST(HammingDistance, CountsTheBitsThatDiffer) {
  Random random(1);
  for (int i = 0; i < 10000; ++i) {
    Descriptor a;
    Descriptor b;
    for (std::uint64_t& word : a.bits) word = random();
    for (std::uint64_t& word : b.bits) word = random() | (i % 3 == 0 ? random() | random() : 0);
    ASSERT_EQ(HammingDistance(a, b), CountBitByBit(a, b));
  }
}

TEST(HammingDistance, OfOppositesIs256) {
  Descriptor ones;
  ones.bits.fill(~std::uint64_t{0});
  EXPECT_EQ(HammingDistance(Descriptor{}, ones), 256);
}

TEST(HammingDistance, OfTheSameIsZero) {
  Descriptor a;
  a.bits = {1, 2, 3, 0xffff'ffff'ffff'ffff};
  EXPECT_EQ(HammingDistance(a, a), 0);
}

}  // namespace
}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/base/large_vector.h"

#include <cstddef>
#include <cstdint>
#include <new>

#include <gtest/gtest.h>

namespace semslam {
namespace {

constexpr std::size_t kMany = std::size_t{3} << 20;  // More than a huge page of any type.

TEST(LargeVector, KeepsItsElementsAsItGrows) {
  LargeVector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < kMany; ++i) numbers.push_back(i);
  LargeVector<std::uint32_t> copy = numbers;
  copy.resize(kMany / 2);
  copy.shrink_to_fit();
  for (std::uint32_t i = 0; i < kMany; ++i) ASSERT_EQ(numbers[i], i);
  for (std::uint32_t i = 0; i < kMany / 2; ++i) ASSERT_EQ(copy[i], i);
}

TEST(LargeVector, GivesElementsTheValueThatIsAskedFor) {
  for (const std::size_t size : {std::size_t{10}, kMany}) {
    const LargeVector<std::uint64_t> zeros(size, 0);
    for (const std::uint64_t zero : zeros) ASSERT_EQ(zero, 0U);
  }
}

TEST(LargeVector, BeginsWithAHugePageIfItFillsOne) {
  const LargeVector<std::uint64_t> numbers(kMany);
  constexpr std::uintptr_t kHugePage = std::uintptr_t{1} << 21;
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(numbers.data()) % kHugePage, 0U);
}

TEST(LargeVector, MoreThanAnyMemoryHoldsThrows) {
  LargeAllocator<std::uint64_t> allocator;
  EXPECT_THROW(allocator.allocate(std::size_t{1} << 62), std::bad_alloc);
}

}  // namespace
}  // namespace semslam

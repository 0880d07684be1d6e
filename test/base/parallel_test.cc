// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace semslam {
namespace {

using Chunk = std::pair<std::size_t, std::size_t>;

std::vector<Chunk> Chunks(std::size_t count, std::size_t grain, int num_threads) {
  std::mutex mutex;
  std::vector<Chunk> chunks;
  ParallelFor(count, grain, num_threads, [&](std::size_t first, std::size_t last) {
    const std::lock_guard lock(mutex);
    chunks.emplace_back(first, last);
  });
  std::sort(chunks.begin(), chunks.end());
  return chunks;
}

TEST(ParallelFor, CoversEveryItemExactlyOnce) {
  for (const std::size_t count : {1, 2, 7, 255, 256, 257, 10'007}) {
    std::size_t expected_first = 0;
    for (const auto& [first, last] : Chunks(count, 1, 4)) {
      EXPECT_EQ(first, expected_first);
      EXPECT_GT(last, first);
      expected_first = last;
    }
    EXPECT_EQ(expected_first, count);
  }
}

TEST(ParallelFor, NeverCallsTheBodyForNoItems) { EXPECT_TRUE(Chunks(0, 1, 4).empty()); }

TEST(ParallelFor, MakesNoChunkSmallerThanTheGrain) {
  for (const std::size_t count : {64, 100, 127, 1000, 12345}) {
    for (const auto& [first, last] : Chunks(count, 64, 3)) EXPECT_GE(last - first, 64u);
  }
  EXPECT_THAT(Chunks(10, 64, 3), testing::ElementsAre(Chunk(0, 10)));
}

TEST(ParallelFor, MakesTheSameChunksOnAnyNumberOfThreads) {
  const std::vector<Chunk> expected = Chunks(5000, 10, 1);
  EXPECT_GT(expected.size(), 10u);
  for (const int num_threads : {0, 2, 3, 8}) EXPECT_EQ(Chunks(5000, 10, num_threads), expected);
}

TEST(ParallelFor, RunsInTheCallersThreadInOrderWithOneThread) {
  const std::thread::id caller = std::this_thread::get_id();
  std::size_t expected_first = 0;
  ParallelFor(1000, 1, 1, [&](std::size_t first, std::size_t last) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    EXPECT_EQ(first, expected_first);
    expected_first = last;
  });
  EXPECT_EQ(expected_first, 1000u);
}

TEST(ParallelFor, PassesAnExceptionOfTheBodyToTheCaller) {
  for (const int num_threads : {1, 2}) {
    const auto run = [num_threads] {
      ParallelFor(100, 1, num_threads, [](std::size_t first, std::size_t) {
        if (first == 50) throw std::domain_error("fifty");
      });
    };
    EXPECT_THROW(run(), std::domain_error);
  }
}

TEST(ParallelFor, MayBeCalledFromItsOwnBody) {
  std::atomic<int> num_items = 0;
  ParallelFor(8, 1, 2, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      ParallelFor(100, 1, 2,
                  [&](std::size_t a, std::size_t b) { num_items += static_cast<int>(b - a); });
    }
  });
  EXPECT_EQ(num_items.load(), 800);
}

}  // namespace
}  // namespace semslam

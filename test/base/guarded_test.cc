// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/base/guarded.h"

#include <latch>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

namespace semslam {
namespace {

TEST(Guarded, BuildsItsValueFromTheArguments) {
  const Guarded<std::string> text(3, 'x');
  EXPECT_EQ(text.Read([](const std::string& value) { return value; }), "xxx");
}

TEST(Guarded, ReturnsByValueEvenIfTheCallbackReturnsAReference) {
  Guarded<std::string> text("abc");
  using Result = decltype(text.Read([](const std::string& value) -> const auto& { return value; }));
  EXPECT_FALSE(std::is_reference_v<Result>);
}

TEST(Guarded, LosesNoUpdateOfConcurrentWriters) {
  constexpr int kNumThreads = 4;
  constexpr int kNumUpdates = 5000;
  Guarded<int> counter(0);
  {
    std::vector<std::jthread> writers;
    for (int i = 0; i < kNumThreads; ++i) {
      writers.emplace_back([&] {
        for (int k = 0; k < kNumUpdates; ++k) counter.Write([](int& value) { ++value; });
      });
    }
  }
  EXPECT_EQ(counter.Read([](int value) { return value; }), kNumThreads * kNumUpdates);
}

TEST(Guarded, LetsSeveralReadersInAtOnce) {
  const Guarded<int> value(1);
  std::latch both_inside(2);  // Opens only if both are inside at the same time.
  const auto read = [&] { value.Read([&](int) { both_inside.arrive_and_wait(); }); };
  const std::jthread a(read);
  const std::jthread b(read);
}

}  // namespace
}  // namespace semslam

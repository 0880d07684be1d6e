// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/base/guarded.h"

#include <chrono>
#include <latch>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/held_lock.h"

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

TEST(Guarded, TellsTheObserverHowLongAThreadWaitedForAnother) {
  Guarded<int> value(0);
  struct Seen {
    std::mutex mutex;
    std::map<std::thread::id, double> seconds;
  } seen;
  value.ObserveWaits([&seen](double seconds) {
    const std::scoped_lock lock(seen.mutex);
    seen.seconds[std::this_thread::get_id()] = seconds;
  });
  constexpr double kHeldSeconds = 0.03;
  std::latch is_held(1);
  std::jthread holder([&] {
    value.Write([&](int&) {
      is_held.count_down();
      std::this_thread::sleep_for(std::chrono::duration<double>(kHeldSeconds));
    });
  });
  const std::thread::id holder_id = holder.get_id();
  is_held.wait();
  value.Read([](int) {});
  holder.join();
  EXPECT_GT(seen.seconds.at(std::this_thread::get_id()), kHeldSeconds / 3);
  EXPECT_LT(seen.seconds.at(holder_id), kHeldSeconds / 3);
}

TEST(Guarded, HasGivenItsLockBackWhenItTellsTheObserver) {
  Guarded<int> value(0);
  bool is_free = false;
  bool was_told = false;
  value.ObserveWaits([&](double) {
    if (std::exchange(was_told, true)) return;
    std::jthread([&] { value.Write([&](int&) { is_free = true; }); }).join();
  });
  value.Write([](int&) {});
  EXPECT_TRUE(is_free);
}

TEST(Guarded, TriesAsLongAsItIsToldTo) {
  Guarded<int> value(7);
  constexpr std::chrono::microseconds kShort(1000);
  testing::HeldLock<int> holder(value);
  EXPECT_FALSE(value.TryRead(kShort, [](int v) { return v; }));
  EXPECT_FALSE(value.TryWrite(kShort, [](int& v) { v = 8; }));
  holder.Release();
  EXPECT_EQ(value.TryRead(kShort, [](int v) { return v; }), 7);
  EXPECT_TRUE(value.TryWrite(kShort, [](int& v) { v = 8; }));
  EXPECT_EQ(value.Read([](int v) { return v; }), 8);
}

TEST(Guarded, WaitsForAShortHold) {
  Guarded<int> value(7);
  std::latch is_held(1);
  const std::jthread holder([&] {
    value.Write([&](int& v) {
      is_held.count_down();
      v = 8;
    });
  });
  is_held.wait();
  EXPECT_EQ(value.TryRead(std::chrono::minutes(1), [](int v) { return v; }), 8);
}

}  // namespace
}  // namespace semslam

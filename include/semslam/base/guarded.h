// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <type_traits>
#include <utility>

#include "semslam/base/stopwatch.h"

namespace semslam {

// A value that can only be reached under its lock. Many readers or one writer at a time.
//   map.Read([](const Map& m) { return m.num_keyframes(); });
// Results come back by value: nothing that points into the value may leave the callback.
template <typename T>
class Guarded {
 public:
  // Told for every Read and Write how long it waited for the lock, in the thread that waited, after
  // it gave the lock back. Must not throw.
  using WaitObserver = std::function<void(double seconds)>;

  template <typename... Args>
  explicit Guarded(Args&&... args) : value_(std::forward<Args>(args)...) {}

  // Before other threads use it. At first there is none.
  void ObserveWaits(WaitObserver observer) { observer_ = std::move(observer); }

  template <typename F>
  auto Read(F&& f) const {
    Wait wait(observer_);
    const std::shared_lock lock(mutex_);
    wait.End();
    return std::forward<F>(f)(value_);
  }

  template <typename F>
  auto Write(F&& f) {
    Wait wait(observer_);
    const std::unique_lock lock(mutex_);
    wait.End();
    return std::forward<F>(f)(value_);
  }

  // For threads that have better things to do than to wait: if the lock is not to be had within
  // `max_wait`, which keeps a core busy, the callback is not called. What it returns; nothing, or
  // false if it returns void, if it was not called.
  template <typename F>
  auto TryRead(std::chrono::microseconds max_wait, F&& f) const {
    Wait wait(observer_);
    std::shared_lock lock(mutex_, std::defer_lock);
    LockWithin(max_wait, lock);
    wait.End();
    return CallIf(lock.owns_lock(), std::forward<F>(f), value_);
  }

  template <typename F>
  auto TryWrite(std::chrono::microseconds max_wait, F&& f) {
    Wait wait(observer_);
    std::unique_lock lock(mutex_, std::defer_lock);
    LockWithin(max_wait, lock);
    wait.End();
    return CallIf(lock.owns_lock(), std::forward<F>(f), value_);
  }

 private:
  // Asks again and again, since whoever sleeps may have lost its core when the lock comes free, and
  // get it back milliseconds later.
  template <typename Lock>
  static void LockWithin(std::chrono::microseconds max_wait, Lock& lock) {
    const auto deadline = std::chrono::steady_clock::now() + max_wait;
    while (!lock.try_lock() && std::chrono::steady_clock::now() < deadline) {
    }
  }

  template <typename F, typename Value>
  static auto CallIf(bool is_locked, F&& f, Value& value) {
    if constexpr (std::is_void_v<std::invoke_result_t<F, Value&>>) {
      if (is_locked) std::forward<F>(f)(value);
      return is_locked;
    } else {
      using Result = std::optional<std::decay_t<std::invoke_result_t<F, Value&>>>;
      return is_locked ? Result(std::forward<F>(f)(value)) : Result();
    }
  }

  // Made before the lock is asked for, so that it goes, and tells the observer, after the lock.
  class Wait {
   public:
    explicit Wait(const WaitObserver& observer) : observer_(observer) {}
    Wait(const Wait&) = delete;
    Wait& operator=(const Wait&) = delete;
    ~Wait() {
      if (observer_) observer_(seconds_);
    }
    void End() {
      if (observer_) seconds_ = stopwatch_.Seconds();
    }

   private:
    const WaitObserver& observer_;
    Stopwatch stopwatch_;
    double seconds_ = 0;
  };

  WaitObserver observer_;
  mutable std::shared_mutex mutex_;
  T value_;
};

}  // namespace semslam

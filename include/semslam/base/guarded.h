// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <mutex>
#include <shared_mutex>
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

 private:
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

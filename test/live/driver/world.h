// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <stop_token>

namespace semslam::testing {

// The time that passes before the virtual camera, from the first start of a stream on, whether
// somebody looks or not. Safe for any threads.
class World {
 public:
  void Start() {
    {
      const std::lock_guard lock(mutex_);
      if (!start_) start_ = Clock::now();
    }
    changed_.notify_all();
  }

  // Seconds since the start; 0 before it.
  double Now() const {
    const std::lock_guard lock(mutex_);
    return start_ ? std::chrono::duration<double>(Clock::now() - *start_).count() : 0;
  }

  // Waits for the start, and then up to that time. False if stopped before.
  bool WaitUntil(double time, const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait(lock, stop, [this] { return start_.has_value(); })) return false;
    const auto due =
        *start_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(time));
    changed_.wait_until(lock, stop, due, [] { return false; });
    return !stop.stop_requested();
  }

 private:
  using Clock = std::chrono::steady_clock;

  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::optional<Clock::time_point> start_;
};

}  // namespace semslam::testing

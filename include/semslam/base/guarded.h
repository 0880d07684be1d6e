// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>
#include <shared_mutex>
#include <utility>

namespace semslam {

// A value that can only be reached under its lock. Many readers or one writer at a time.
//   map.Read([](const Map& m) { return m.num_keyframes(); });
// Results come back by value: nothing that points into the value may leave the callback.
template <typename T>
class Guarded {
 public:
  template <typename... Args>
  explicit Guarded(Args&&... args) : value_(std::forward<Args>(args)...) {}

  template <typename F>
  auto Read(F&& f) const {
    const std::shared_lock lock(mutex_);
    return std::forward<F>(f)(value_);
  }

  template <typename F>
  auto Write(F&& f) {
    const std::unique_lock lock(mutex_);
    return std::forward<F>(f)(value_);
  }

 private:
  mutable std::shared_mutex mutex_;
  T value_;
};

}  // namespace semslam

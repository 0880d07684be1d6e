// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <latch>
#include <thread>
#include <utility>

#include "semslam/base/guarded.h"

namespace semslam::testing {

// Another thread that has done its edit and keeps the lock, until Release or the end of the scope.
template <typename T>
class HeldLock {
 public:
  explicit HeldLock(
      Guarded<T>& guarded, std::function<void(T&)> edit = [](T&) {})
      : holder_([this, &guarded, edit = std::move(edit)] {
          guarded.Write([&](T& value) {
            edit(value);
            is_held_.count_down();
            may_go_.wait();
          });
        }) {
    is_held_.wait();
  }
  HeldLock(const HeldLock&) = delete;
  HeldLock& operator=(const HeldLock&) = delete;
  ~HeldLock() { Release(); }

  void Release() {
    if (!holder_.joinable()) return;
    may_go_.count_down();
    holder_.join();
  }

 private:
  std::latch is_held_{1};
  std::latch may_go_{1};
  std::jthread holder_;  // Last, so that the latches are there when it starts.
};

}  // namespace semslam::testing

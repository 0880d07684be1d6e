// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

namespace semslam {

// OpenGL without a window, and without a window system: EGL's surfaceless platform. While it lives,
// its context is the current one of the thread that made it, and it must be destroyed there.
class OffscreenContext {
 public:
  // Throws InputError if there is no OpenGL 3.3 here.
  OffscreenContext();
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace semslam

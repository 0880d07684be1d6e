// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <thread>

namespace semslam {

// Waits. Only for what is outside and cannot say when it is ready, such as a camera that is being
// plugged in; threads of the program wait for each other by BoundedQueue and Stage.
inline void Pause(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <csignal>

// Set by Ctrl-C or a request to end: the only thing a signal handler may touch.
inline volatile std::sig_atomic_t interrupt_requested = 0;

inline void InstallInterruptHandler() {
  struct sigaction action {};
  action.sa_handler = [](int) { interrupt_requested = 1; };
  // A second Ctrl-C ends the program at once.
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

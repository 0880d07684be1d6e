// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stop_token>
#include <string>

#include "semslam/viewer/live_source.h"

namespace semslam {

struct LiveWindowOptions {
  std::string title = "semslam";
  int width = 1440;  // Pixels.
  int height = 900;
};

// Shows a run in a window, in the calling thread, until the window is closed or a stop is
// requested. Draws less often and fewer points where there is no graphics card. Throws InputError
// if there is no screen or no OpenGL 3.3. One window at a time in a process.
void ShowRun(LiveSource& source, const LiveWindowOptions& options, const std::stop_token& stop);

}  // namespace semslam

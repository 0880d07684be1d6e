// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <algorithm>
#include <thread>

#include <opencv2/core/utility.hpp>

// Tracking keeps a core busy; OpenCV's own threads (the detector's) share the others.
inline void LeaveACoreToTracking() {
  cv::setNumThreads(std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1));
}

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "semslam/base/time.h"

namespace semslam {

// A camera's clock tells exactly how much time lies between frames, and nothing else: it starts
// anywhere, and anew when the camera is plugged in again. This turns its microseconds into times
// since 1970 that always increase: set by the system's clock at the first frame, and again
// wherever the two clocks have come apart by more than a second.
class DeviceClock {
 public:
  TimeNs Convert(std::int64_t time_us, TimeNs system_time);

  // The camera was opened anew.
  void Restart() { offset_.reset(); }

 private:
  std::optional<TimeNs> offset_;  // From the camera's time to ours.
  std::optional<TimeNs> last_;
};

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "live/device_clock.h"

#include <algorithm>
#include <cstdlib>

namespace semslam {

TimeNs DeviceClock::Convert(std::int64_t time_us, TimeNs system_time) {
  constexpr TimeNs kMaxDifference = kNsPerSecond;
  const TimeNs device_time = time_us * 1000;
  if (!offset_ || std::abs(device_time + *offset_ - system_time) > kMaxDifference)
    offset_ = system_time - device_time;
  TimeNs time = device_time + *offset_;
  if (last_) time = std::max(time, *last_ + 1000);
  last_ = time;
  return time;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "semslam/tracking/tracking.h"

// In a word, for people.
inline const char* StateName(semslam::TrackingState state) {
  switch (state) {
    case semslam::TrackingState::kNotInitialized:
      return "waiting";
    case semslam::TrackingState::kTracking:
      return "tracking";
    case semslam::TrackingState::kLost:
      return "lost";
  }
  return "";
}

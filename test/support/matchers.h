// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>

#include "semslam/geometry/rigid3.h"

namespace semslam::testing {

// The pose is within `max_angle` (rad) and `max_distance` (m) of the expected one.
//   EXPECT_THAT(T_world_camera, Rigid3Near(expected, 1e-6, 1e-6));
MATCHER_P3(Rigid3Near, expected, max_angle, max_distance, "") {
  const double angle = RotationAngle(arg, expected);
  const double distance = (arg.translation - expected.translation).norm();
  *result_listener << "is " << angle << " rad and " << distance << " m away";
  return angle <= max_angle && distance <= max_distance;
}

}  // namespace semslam::testing

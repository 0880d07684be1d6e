// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <gtest/gtest.h>

#include "semslam/pipeline/system.h"

namespace semslam::testing {

inline void ExpectSameBits(const std::vector<System::TrackedPose>& a,
                           const std::vector<System::TrackedPose>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].time, b[i].time);
    EXPECT_EQ(a[i].T_world_camera.ToMatrix(), b[i].T_world_camera.ToMatrix()) << "pose " << i;
  }
}

}  // namespace semslam::testing

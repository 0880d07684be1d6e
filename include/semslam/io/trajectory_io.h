// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "semslam/base/time.h"
#include "semslam/geometry/rigid3.h"

namespace semslam {

struct TimedPose {
  TimeNs time = 0;
  Rigid3 T_world_camera;
};

using Trajectory = std::vector<TimedPose>;

// Reads a trajectory in the format of the TUM RGB-D benchmark: a line `t tx ty tz qx qy qz qw` a
// pose, in seconds and metres, with spaces, tabs or commas between; # starts a comment. Quaternions
// are normalised; the poses come out sorted by time. Throws InputError with file, line and what was
// found. A file without any pose is no error.
Trajectory ReadTrajectory(const std::filesystem::path& path);

// Writes the same format, times with 6 decimals and the rest with 9. The file appears complete or
// not at all. Throws InputError.
void WriteTrajectory(const std::filesystem::path& path, const Trajectory& trajectory);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "semslam/io/trajectory_io.h"
#include "semslam/pipeline/system.h"

semslam::Trajectory ToTrajectory(const std::vector<semslam::System::TrackedPose>& poses);

// Writes the trajectories, clouds, objects and pictures of a run. Each file appears whole or not at
// all; trajectories and map do not keep each other from being written. Returns the first thing that
// went wrong, or nothing.
std::string WriteResults(const std::filesystem::path& folder,
                         const semslam::System& system,
                         const semslam::PointCloudMapping::Result& map);

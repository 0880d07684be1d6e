// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "semslam/pipeline/system.h"

// Writes the trajectories, clouds, objects and pictures of a run. Each file appears whole or not at
// all; a file that cannot be written does not keep the others from being written. Returns what went
// wrong, a line each.
std::vector<std::string> WriteResults(const std::filesystem::path& folder,
                                      const semslam::System& system,
                                      const semslam::PointCloudMapping::Result& map);

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>

#include "semslam/pipeline/system.h"

#include "run_loop.h"

// Prints what a run did, for people, to standard output.
void PrintSummary(const RunStatistics& run,
                  const semslam::System& system,
                  const semslam::PointCloudMapping::Result& map,
                  const std::filesystem::path& output);

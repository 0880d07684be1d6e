// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>

#include "semslam/io/cloud_io.h"

// Writes a PNG file with the cloud in its colours and in those of its segments, seen from behind
// and above the viewer. Throws semslam::InputError.
void WriteSegmentPicture(const std::filesystem::path& path, const semslam::CloudView& cloud);

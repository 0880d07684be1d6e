// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace semslam {

// Whether this names a file rather than a camera.
bool IsOniFile(const std::string& device);

// Throws InputError unless there is a file that begins as a recording of OpenNI2 does. OpenNI2
// itself says nothing of use.
void CheckOniFile(const std::filesystem::path& path);

// The n-th part of a recording: clip.oni, clip_2.oni, ... A camera that was away goes on in another
// file: such files cannot be continued.
std::filesystem::path RecordingPart(const std::filesystem::path& path, int part);

}  // namespace semslam

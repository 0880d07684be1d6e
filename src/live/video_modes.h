// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "semslam/live/device_list.h"

#include "live/frame_pairer.h"

namespace openni {
class SensorInfo;
class VideoMode;
}  // namespace openni

namespace semslam {

OpenNi2Mode ToMode(const openni::VideoMode& mode);
std::vector<OpenNi2Mode> ToModes(const openni::SensorInfo& sensor);

// "640x480, 30/s, RGB888".
std::string Describe(const OpenNi2Mode& mode);

// Index of the mode to ask for: of that size, in a format that can be converted, the best one
// first (RGB888; 1 mm), at the rate that is nearest. Nothing if no mode has the size and such a
// format.
std::optional<std::size_t> ChooseMode(
    const std::vector<OpenNi2Mode>& modes, StreamKind kind, int width, int height, int fps);

}  // namespace semslam

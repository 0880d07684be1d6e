// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace semslam {

// How a stream can be sent.
struct OpenNi2Mode {
  int width = 0;   // Pixels.
  int height = 0;  // Pixels.
  int fps = 0;     // Frames per second.
  std::string format;
};

// A camera that OpenNI2 knows of.
struct OpenNi2Device {
  std::string uri;
  std::string vendor;
  std::string name;
  std::string problem;  // Why it cannot be opened; empty: it can.
  std::vector<OpenNi2Mode> color_modes;
  std::vector<OpenNi2Mode> depth_modes;
  bool can_register = false;  // Depth to colour, by itself.
};

// What to tell, and to do, if there is none.
inline constexpr char kNoCameraFound[] =
    "no camera found: is it plugged in, at a port that gives it power, and does lsusb list it? "
    "Then unplug it and plug it in again";

// All cameras that are plugged in, opened for a moment to ask what they can do. Throws InputError
// if OpenNI2 itself does not work.
std::vector<OpenNi2Device> ListOpenNi2Devices();

}  // namespace semslam

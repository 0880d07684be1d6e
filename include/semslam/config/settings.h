// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "semslam/camera/pinhole_camera.h"

namespace semslam {

// All that a settings file says. The fields' defaults are those of the optional keys; what has no
// sensible default must be in the file. config/README.md lists every key.
struct Settings {
  // ORBextractor.*: the keys of the published system.
  struct Orb {
    int num_features = 1000;     // Wanted per image.
    double scale_factor = 1.2;   // Between two levels of the pyramid.
    int num_levels = 8;          // Of the pyramid.
    int initial_threshold = 20;  // FAST, grey levels.
    int minimum_threshold = 7;   // FAST, where the first finds nothing.
  };

  PinholeCamera::Parameters camera;
  double fps = 30;                 // Frames per second of the recording.
  double bf = 40;                  // Baseline times fx, pixels * metres.
  double close_depth_factor = 40;  // ThDepth: a depth is close if below this many baselines.
  double depth_factor = 5000;      // Value of a depth pixel at 1 m.
  bool is_rgb = true;              // Camera.RGB; images from files say their order themselves.
  Orb orb;

  // What the file holds that nothing here asks for; to be shown to the user once.
  std::vector<std::string> warnings;

  // Depths below this are close (m).
  double CloseDepth() const { return close_depth_factor * bf / camera.fx; }
};

// Reads a settings file, as it comes with ORB-SLAM2 (TUM1.yaml ...) or with more keys of ours.
// Throws InputError naming file, key, what was found and what is allowed.
Settings LoadSettings(const std::filesystem::path& path);

}  // namespace semslam

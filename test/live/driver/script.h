// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace semslam::testing {

// What the virtual camera shows and what goes wrong with it: a text file, a line an entry, whose
// path stands in the environment variable SEMSLAM_TEST_CAMERA.
//   size WIDTH HEIGHT              of all images; 640 480
//   fps FRAMES                     30
//   clip FOLDER ASSOCIATIONS FACTOR  a clip in TUM's format; without one, a moving pattern
//   refuse THING                   registration, sync, mirroring, exposure, color, depth, rgb, size
//   absent                         no camera
//   busy                           somebody else has it
//   unplug AT SECONDS              faults begin AT seconds after the first start of a stream and
//   stall AT SECONDS               last for SECONDS; the clip goes on meanwhile
//   no_color AT SECONDS
//   no_depth AT SECONDS
//   format AT SECONDS              colour in half the size
struct Script {
  struct Fault {
    std::string kind;
    double begin = 0;  // Seconds.
    double end = 0;
  };

  int width = 640;
  int height = 480;
  int fps = 30;
  std::filesystem::path clip;
  std::filesystem::path associations;
  double depth_factor = 5000;
  std::set<std::string> refused;
  bool is_absent = false;
  bool is_busy = false;
  std::vector<Fault> faults;

  bool Refuses(const std::string& what) const { return refused.count(what) > 0; }
  // Whether such a fault is on, `time` seconds after the first start.
  bool IsOn(const std::string& kind, double time) const;
};

// Throws std::runtime_error for a line that it does not know.
Script ReadScript(const std::filesystem::path& path);

}  // namespace semslam::testing

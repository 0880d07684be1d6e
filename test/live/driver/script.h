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
//   color FORMAT ...               what it offers, the first one being set: RGB888 by default, or
//                                  YUV422, YUYV, GRAY8, JPEG (which it can only offer)
//   depth FORMAT ...               1mm 100um
//   refuse THING                   registration, sync, mirroring, unmirroring (images stay so),
//                                  exposure, color, depth, size
//   absent                         no camera
//   locked REASON                  it cannot be opened
//   unplug AT SECONDS              faults begin AT seconds after the first start of a stream and
//   stall AT SECONDS               last for SECONDS; the clip goes on meanwhile
//   no_color AT SECONDS
//   no_depth AT SECONDS
//   format AT SECONDS              colour in half the size
//   gray AT SECONDS                colour as GRAY8
//
// Colour is dark unless its exposure is automatic, which it is not at first. Without registration
// depth is shifted to the right by kParallax; without synchronisation it is that of the next frame
// and has times later by kLateDepth.
struct Script {
  struct Fault {
    std::string kind;
    double begin = 0;  // Seconds.
    double end = 0;
  };

  static constexpr int kParallax = 5;       // Pixels.
  static constexpr int kLateDepth = 12000;  // Microseconds.

  int width = 640;
  int height = 480;
  int fps = 30;
  std::filesystem::path clip;
  std::filesystem::path associations;
  double depth_factor = 5000;
  std::vector<std::string> color_formats = {"RGB888"};
  std::vector<std::string> depth_formats = {"1mm", "100um"};
  std::set<std::string> refused;
  bool is_absent = false;
  std::string lock;  // Why it cannot be opened; empty: it can.
  std::vector<Fault> faults;

  bool Refuses(const std::string& what) const { return refused.count(what) > 0; }
  // Whether such a fault is on, `time` seconds after the first start.
  bool IsOn(const std::string& kind, double time) const;
};

// Throws std::runtime_error for a line that it does not know.
Script ReadScript(const std::filesystem::path& path);

}  // namespace semslam::testing

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "semslam/config/settings.h"
#include "semslam/semantics/detector.h"

// The command line of rgbd_tum.
struct Arguments {
  std::filesystem::path vocabulary;
  std::filesystem::path settings;
  std::filesystem::path sequence;
  std::filesystem::path associations;  // "-": by nearest time.
  std::filesystem::path output = ".";
  std::vector<std::string> network;  // CFG WEIGHTS NAMES, or empty.
  std::filesystem::path detections;  // Folder of recorded detections, or empty.
  std::vector<std::string> classes;  // Of interest; empty: as the settings say.
  std::optional<double> score;
  std::filesystem::path load_map;  // Empty: a new map.
  std::filesystem::path save_map;  // Empty: not saved.
  bool localization = false;
  bool no_semantics = false;
  bool save_detections = false;
  bool sequential = false;
  bool realtime = false;
};

struct ParseResult {
  Arguments arguments;
  std::optional<int>
      exit_code;  // Set if there is nothing to run: --help, --version, or wrong usage.
};

// Prints help and complaints itself.
ParseResult ParseArguments(int argc, char** argv);

// The detector that command line and settings ask for, or null for none. Throws semslam::InputError
// if it cannot be had.
std::unique_ptr<semslam::Detector> MakeDetector(const Arguments& arguments,
                                                const semslam::DetectorSettings& settings);

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

namespace CLI {
class App;
}

// The command line that the mapping programs share.
struct MappingArguments {
  std::filesystem::path vocabulary;
  std::filesystem::path settings;
  std::filesystem::path output = ".";
  std::vector<std::string> network;  // CFG WEIGHTS NAMES, FILE.onnx NAMES, or empty.
  std::filesystem::path detections;  // Folder of recorded detections, or empty.
  std::vector<std::string> classes;  // Of interest; empty: as the settings say.
  std::optional<double> score;
  std::filesystem::path load_map;  // Empty: a new map.
  std::filesystem::path save_map;  // Empty: not saved.
  bool localization = false;
  bool no_semantics = false;
  bool save_detections = false;
  bool drop_late = false;
  bool sequential = false;
  bool realtime = false;
  bool viewer = false;        // A window while it runs,
  bool viewer_stays = false;  // and afterwards, until it is closed.
};

// An application with --help and --version in this project's form.
std::unique_ptr<CLI::App> MakeApp(const std::string& name, const std::string& description);

// VOCABULARY SETTINGS.
void AddMappingPositionals(CLI::App& app, MappingArguments& arguments);
// `realtime` says what --realtime does.
void AddMappingOptions(CLI::App& app, MappingArguments& arguments, const std::string& realtime);

// Prints help and complaints itself. The exit code if there is nothing to run: --help, --version,
// or wrong usage.
std::optional<int> Parse(CLI::App& app, int argc, char** argv);

// The detector that command line and settings ask for, or null for none. Throws semslam::InputError
// if it cannot be had.
std::unique_ptr<semslam::Detector> MakeDetector(const MappingArguments& arguments,
                                                const semslam::DetectorSettings& settings);

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// What is in a map that rgbd_tum --save-map wrote, and its clouds and objects as files:
//   map_info desk.map --output RESULT
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "semslam/base/error.h"
#include "semslam/base/time.h"
#include "semslam/config/settings.h"
#include "semslam/io/atomic_file.h"
#include "semslam/pipeline/system.h"

#include "RGB-D/result_files.h"
#include "run_program.h"
#include "saved_map.h"

namespace {

struct Arguments {
  std::filesystem::path map;
  std::filesystem::path output;
};

void AddArguments(CLI::App& app, Arguments& arguments) {
  app.add_option("MAP", arguments.map, "Map file")->required();
  app.add_option("--output", arguments.output,
                 "Write trajectories, clouds, objects and pictures into this folder");
  app.set_version_flag("--version", "map_info " SEMSLAM_VERSION);
}

void Print(const Arguments& arguments,
           const semslam::Settings& settings,
           const semslam::System& system) {
  const semslam::System::Status status = system.status();
  const auto frames = system.CameraTrajectory();
  std::printf("map                   %s, %.1f MB\n", arguments.map.c_str(),
              static_cast<double>(std::filesystem::file_size(arguments.map)) / 1e6);
  std::printf("camera                %dx%d, fx %.3f fy %.3f cx %.3f cy %.3f\n",
              settings.camera.width, settings.camera.height, settings.camera.fx, settings.camera.fy,
              settings.camera.cx, settings.camera.cy);
  std::printf("frames                %zu", frames.size());
  if (!frames.empty()) {
    std::printf(", %s to %s s", semslam::FormatTime(frames.front().time).c_str(),
                semslam::FormatTime(frames.back().time).c_str());
  }
  std::printf("\nkeyframes             %zu\n", status.num_keyframes);
  std::printf("landmarks             %zu\n", status.num_landmarks);
  std::printf("map points            %zu\n", status.num_voxels);
}

int Run(const Arguments& arguments) {
  const semslam::Settings settings = semslam::System::ReadMapSettings(arguments.map);
  const std::unique_ptr<semslam::System> system = OpenSavedMap(arguments.map, settings);
  if (!arguments.output.empty()) semslam::CheckOutputFolder(arguments.output);
  Print(arguments, settings, *system);
  if (arguments.output.empty()) return 0;
  const std::string error = WriteResults(arguments.output, *system, system->Shutdown());
  if (!error.empty()) throw semslam::InputError(error);
  std::printf("files                 %s\n",
              std::filesystem::absolute(arguments.output).lexically_normal().c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return RunProgram<Arguments>("map_info", "Tells what is in a map that rgbd_tum --save-map wrote.",
                               argc, argv, AddArguments, Run);
}

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// Shows what a mapping program wrote, in a window, or in a picture where there is none:
//   view_map RESULT
//   view_map RESULT --picture map.png --from top --color classes
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>

#include <CLI/CLI.hpp>

#include "semslam/base/error.h"
#include "semslam/io/atomic_file.h"
#include "semslam/io/png_writer.h"
#include "semslam/viewer/map_window.h"
#include "semslam/viewer/picture.h"

#include "interrupt.h"
#include "opened_map.h"
#include "run_program.h"

namespace {

using semslam::ColorMode;
using semslam::Viewpoint;

std::map<std::string, Viewpoint> Viewpoints() {
  return {{"top", Viewpoint::kTop},     {"view", Viewpoint::kPerspective},
          {"front", Viewpoint::kFront}, {"back", Viewpoint::kBack},
          {"left", Viewpoint::kLeft},   {"right", Viewpoint::kRight}};
}

std::map<std::string, ColorMode> ColorModes() {
  return {{"photo", ColorMode::kPhoto},
          {"segments", ColorMode::kSegments},
          {"classes", ColorMode::kClasses},
          {"height", ColorMode::kHeight}};
}

struct Arguments {
  std::filesystem::path map;
  std::filesystem::path picture;
  std::string from = "view";
  std::string color = "photo";
  std::string size = "1280x800";
  std::string eye_dome = "on";
  std::string overlay = "on";
};

template <typename T>
std::vector<std::string> Names(const std::map<std::string, T>& choices) {
  std::vector<std::string> names;
  for (const auto& [name, value] : choices) names.push_back(name);
  return names;
}

void AddArguments(CLI::App& app, Arguments& arguments) {
  app.add_option("MAP", arguments.map, "Folder of results, map of --save-map, or PCD or PLY file")
      ->required();
  app.add_option("--picture", arguments.picture,
                 "No window: write a picture; needs no window system")
      ->type_name("FILE.png");
  app.add_option("--from", arguments.from, "Where the picture is taken from (default: view)")
      ->check(CLI::IsMember(Names(Viewpoints())));
  app.add_option("--color", arguments.color, "What the colours tell (default: photo)")
      ->check(CLI::IsMember(Names(ColorModes())));
  app.add_option("--size", arguments.size, "Of picture or window (default: 1280x800)")
      ->type_name("WxH");
  app.add_option("--eye-dome", arguments.eye_dome, "Shading by depth (default: on)")
      ->check(CLI::IsMember({"on", "off"}));
  app.add_option("--overlay", arguments.overlay, "Grid, trajectory, objects, legend (default: on)")
      ->check(CLI::IsMember({"on", "off"}));
  app.set_version_flag("--version", "view_map " SEMSLAM_VERSION);
}

void ParseSize(const std::string& text, int* width, int* height) {
  char rest = 0;
  if (std::sscanf(text.c_str(), "%5dx%5d%c", width, height, &rest) == 2) return;
  throw semslam::InputError("--size: expected WIDTHxHEIGHT in pixels, found " + text);
}

semslam::PictureOptions Options(const Arguments& arguments) {
  semslam::PictureOptions options;
  ParseSize(arguments.size, &options.width, &options.height);
  options.from = Viewpoints().at(arguments.from);
  options.color = ColorModes().at(arguments.color);
  options.eye_dome = arguments.eye_dome == "on";
  const bool overlay = arguments.overlay == "on";
  options.legend = overlay;
  options.overlay.grid = overlay;
  options.overlay.trajectory = overlay;
  options.overlay.objects = overlay;
  options.Validate();
  return options;
}

int Run(const Arguments& arguments) {
  const semslam::PictureOptions options = Options(arguments);
  if (!arguments.picture.empty())
    semslam::CheckOutputFolder(std::filesystem::absolute(arguments.picture).parent_path());
  const OpenedMap map(arguments.map);
  if (arguments.picture.empty()) {
    InstallInterruptHandler();
    semslam::ShowMap(map.scene(), {.title = arguments.map.string() + " - semslam",
                                   .width = options.width,
                                   .height = options.height,
                                   .color = options.color,
                                   .should_close = [] { return interrupt_requested != 0; }});
    return 0;
  }
  semslam::WritePng(arguments.picture, semslam::TakePicture(map.scene(), options),
                    semslam::PngContent::kPhoto);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return RunProgram<Arguments>("view_map", "Shows what a mapping program wrote.", argc, argv,
                               AddArguments, Run);
}

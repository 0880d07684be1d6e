// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
// Writes a made-up RGB-D recording, with exact truth, in the format of the TUM RGB-D benchmark.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <unistd.h>

#include "semslam/base/stopwatch.h"
#include "semslam/render/clip.h"
#include "semslam/render/clip_writer.h"

#include "printable.h"

namespace {

struct Arguments {
  std::filesystem::path folder;
  std::string camera = "TUM1";
  bool clean = false;
  semslam::RenderedClip::Options clip;
};

std::string Listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

void AddArguments(CLI::App& app, Arguments& arguments) {
  app.add_option(
         "SCENE", arguments.clip.scene,
         "What to render: " + Listed(semslam::SceneNames()) + ", or the path of a scene file")
      ->required();
  app.add_option("OUT", arguments.folder, "Folder to write")->required();
  app.add_option("--frames", arguments.clip.num_frames, "Number of frames")->capture_default_str();
  app.add_option("--seed", arguments.clip.seed, "Of objects, camera path and noise")
      ->capture_default_str();
  app.add_option("--camera", arguments.camera,
                 Listed(semslam::CameraNames()) + "; TUM1 has lens distortion")
      ->capture_default_str();
  app.add_option("--fps", arguments.clip.fps, "Frames a second")->capture_default_str();
  app.add_option("--threads", arguments.clip.num_threads, "0: one per core")->capture_default_str();
  app.add_flag("--clean", arguments.clean, "No noise, blur or missing depth; perfect detections");
  app.set_version_flag("--version", "render_clip " SEMSLAM_VERSION);
}

void Run(Arguments arguments) {
  arguments.clip.camera = semslam::CameraByName(arguments.camera);
  semslam::DetectionOptions detections;
  if (arguments.clean) {
    arguments.clip.MakeClean();
    detections.miss_rate = 0;
    detections.box_jitter = 0;
  }
  const semslam::RenderedClip clip(arguments.clip);
  const semslam::Stopwatch watch;
  const bool has_terminal = ::isatty(STDERR_FILENO) != 0;
  const auto rate = [&](std::size_t num_frames) {
    return static_cast<double>(num_frames) / watch.Seconds();
  };
  semslam::WriteClip(clip, arguments.folder, detections, [&](std::size_t num_written) {
    if (!has_terminal) return;
    std::fprintf(stderr, "\r%zu of %zu frames, %.1f a second ", num_written, clip.num_frames(),
                 rate(num_written));
    if (num_written == clip.num_frames()) std::fprintf(stderr, "\n");
  });
  std::printf("%s: %zu frames of %s, %zu objects, %.1f frames a second\n", arguments.folder.c_str(),
              clip.num_frames(), arguments.clip.scene.c_str(), clip.instances().size(),
              rate(clip.num_frames()));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Arguments arguments;
    CLI::App app("Renders an RGB-D clip with exact truth, as a folder in the TUM RGB-D format.");
    AddArguments(app, arguments);
    try {
      app.parse(argc, argv);
    } catch (const CLI::Success& help) {
      return app.exit(help);
    } catch (const CLI::ParseError& error) {
      throw std::runtime_error(std::string(error.what()) + " (--help shows the usage)");
    }
    Run(arguments);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "render_clip: " << Printable(error.what()) << '\n';
    return 1;
  }
}

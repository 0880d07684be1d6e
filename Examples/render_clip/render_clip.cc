// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
// Writes a made-up RGB-D recording, with exact truth, in the format of the TUM RGB-D benchmark.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

#include <CLI/CLI.hpp>

#include "semslam/base/stopwatch.h"
#include "semslam/render/clip.h"
#include "semslam/render/clip_writer.h"

namespace {

struct Arguments {
  std::filesystem::path folder;
  std::string camera = "TUM1";
  bool clean = false;
  semslam::RenderedClip::Options clip;
};

void AddArguments(CLI::App& app, Arguments& arguments) {
  app.add_option("SCENE", arguments.clip.scene, "What to render: desk, wall")->required();
  app.add_option("OUT", arguments.folder, "Folder to write")->required();
  app.add_option("--frames", arguments.clip.num_frames, "Number of frames")->capture_default_str();
  app.add_option("--seed", arguments.clip.seed, "Of objects, camera path and noise")
      ->capture_default_str();
  app.add_option("--camera", arguments.camera, "TUM1 (with lens distortion), TUM3, Xtion")
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
  semslam::WriteClip(clip, arguments.folder, detections, [&](std::size_t num_written) {
    std::fprintf(stderr, "\r%zu of %zu frames, %.1f a second ", num_written, clip.num_frames(),
                 static_cast<double>(num_written) / watch.Seconds());
  });
  std::fprintf(stderr, "\n");
  std::cout << arguments.folder.string() << ": " << clip.num_frames() << " frames of "
            << arguments.clip.scene << ", " << clip.instances().size() << " objects\n";
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Arguments arguments;
    CLI::App app("Renders an RGB-D clip with exact truth, as a folder in the TUM RGB-D format.");
    AddArguments(app, arguments);
    CLI11_PARSE(app, argc, argv);
    Run(arguments);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "render_clip: " << error.what() << '\n';
    return 1;
  }
}

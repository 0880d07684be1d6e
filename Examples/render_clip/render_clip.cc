// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
// Writes a made-up RGB-D recording, with exact truth, in the format of the TUM RGB-D benchmark.
#include <cstddef>
#include <cstdio>
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

#include "interrupt.h"
#include "printable.h"
#include "run_program.h"

namespace {

struct Arguments {
  std::filesystem::path folder;
  std::string camera = "TUM1";
  bool clean = false;
  bool no_color_noise = false;
  bool no_blur = false;
  bool no_exposure_change = false;
  bool no_depth_noise = false;
  bool no_depth_holes = false;
  bool no_distortion = false;
  std::string cover;
  semslam::RenderedClip::Options clip;
};

struct Interrupted {};

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
  const char* effects = "Sensor effects";
  app.add_flag("--no-color-noise", arguments.no_color_noise, "No noise in colour")->group(effects);
  app.add_flag("--no-blur", arguments.no_blur, "No motion blur")->group(effects);
  app.add_flag("--no-exposure-change", arguments.no_exposure_change,
               "Constant exposure, no dark corners")
      ->group(effects);
  app.add_flag("--no-depth-noise", arguments.no_depth_noise, "Depth without noise and steps")
      ->group(effects);
  app.add_flag("--no-depth-holes", arguments.no_depth_holes,
               "Depth everywhere: no shadow, range, frayed edges")
      ->group(effects);
  app.add_flag("--no-distortion", arguments.no_distortion, "The camera without lens distortion")
      ->group(effects);
  app.add_option("--cover", arguments.cover,
                 "The lens is covered in this time: seconds since the start")
      ->type_name("FROM:TO")
      ->group(effects);
  app.set_version_flag("--version", "render_clip " SEMSLAM_VERSION);
}

semslam::RenderedClip::Options::Interval ParseInterval(const std::string& text) {
  semslam::RenderedClip::Options::Interval interval;
  int length = 0;
  const int num_read =
      std::sscanf(text.c_str(), "%lf:%lf%n", &interval.from_s, &interval.to_s, &length);
  if (num_read != 2 || static_cast<std::size_t>(length) != text.size())
    throw std::runtime_error("--cover: expected FROM:TO in seconds, found " + text);
  return interval;
}

void ApplyEffects(const Arguments& arguments, semslam::RenderedClip::Options* clip) {
  if (arguments.clean) clip->MakeClean();
  if (arguments.no_color_noise) clip->color.read_noise = clip->color.shot_noise = 0;
  if (arguments.no_blur) clip->color.exposure_s = 0;
  if (arguments.no_exposure_change) clip->color.gain_drift = clip->color.vignetting = 0;
  if (arguments.no_depth_noise) clip->depth.disparity_noise_px = clip->depth.disparity_step_px = 0;
  if (arguments.no_depth_holes) {
    const double noise = clip->depth.disparity_noise_px;
    const double step = clip->depth.disparity_step_px;
    clip->depth = semslam::DepthSensorOptions::Clean();
    clip->depth.disparity_noise_px = noise;
    clip->depth.disparity_step_px = step;
  }
  if (arguments.no_distortion) {
    semslam::PinholeCamera::Parameters& camera = clip->camera;
    camera.k1 = camera.k2 = camera.p1 = camera.p2 = camera.k3 = 0;
  }
  if (!arguments.cover.empty()) clip->covered = ParseInterval(arguments.cover);
}

// `[#####.....]  72 of 150 frames, 12.3 a second, 6 s left`, over the line before.
void ShowProgress(std::size_t num_written, std::size_t num_frames, double seconds) {
  constexpr std::size_t kBarWidth = 30;
  const std::size_t filled = kBarWidth * num_written / num_frames;
  const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
  const double rate = static_cast<double>(num_written) / seconds;
  std::fprintf(stderr, "\r\033[K[%s] %zu of %zu frames, %.1f a second, %.0f s left", bar.c_str(),
               num_written, num_frames, rate, static_cast<double>(num_frames - num_written) / rate);
}

void Render(Arguments arguments) {
  arguments.clip.camera = semslam::CameraByName(arguments.camera);
  ApplyEffects(arguments, &arguments.clip);
  semslam::DetectionOptions detections;
  if (arguments.clean) detections.miss_rate = detections.box_jitter = 0;
  const semslam::RenderedClip clip(arguments.clip);
  const semslam::Stopwatch watch;
  const bool has_terminal = ::isatty(STDERR_FILENO) != 0;
  const auto progress = [&](std::size_t num_written) {
    if (interrupt_requested != 0) throw Interrupted{};
    if (has_terminal) ShowProgress(num_written, clip.num_frames(), watch.Seconds());
  };
  try {
    semslam::WriteClip(clip, arguments.folder, detections, progress);
  } catch (...) {
    if (has_terminal) std::fprintf(stderr, "\n");  // The progress stays to be read.
    throw;
  }
  if (has_terminal) std::fprintf(stderr, "\r\033[K");
  std::printf("%s: %zu frames of %s, %zu objects, %.1f frames a second\n", arguments.folder.c_str(),
              clip.num_frames(), arguments.clip.scene.c_str(), clip.instances().size(),
              static_cast<double>(clip.num_frames()) / watch.Seconds());
}

int Run(const Arguments& arguments) {
  InstallInterruptHandler();
  try {
    Render(arguments);
  } catch (const Interrupted&) {
    std::cerr << "render_clip: interrupted: " << Printable(arguments.folder.string())
              << " is unfinished and has no lists of frames\n";
    return 130;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return RunProgram<Arguments>(
      "render_clip", "Renders an RGB-D clip with exact truth, as a folder in the TUM RGB-D format.",
      argc, argv, AddArguments, Run);
}

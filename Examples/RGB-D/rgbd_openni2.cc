// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// Maps live with an Asus Xtion or another camera that OpenNI2 knows, or from a recording of one:
//   rgbd_openni2 Vocabulary/orb.voc config/Xtion.yaml --output RESULT
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "semslam/base/error.h"
#include "semslam/io/atomic_file.h"
#include "semslam/io/tum_recorder.h"
#include "semslam/live/openni2_source.h"

#include "arguments.h"
#include "camera_intrinsics.h"
#include "device_table.h"
#include "interrupt.h"
#include "mapping_run.h"
#include "printable.h"
#include "progress_line.h"
#include "run_loop.h"

namespace {

constexpr const char* kName = "rgbd_openni2";
constexpr int kCameraLost = 3;  // Exit code.

struct Arguments : MappingArguments {
  std::string device;
  bool unregistered = false;
  bool device_intrinsics = false;
  std::filesystem::path record;
  std::filesystem::path record_tum;
  std::optional<double> duration;  // Seconds.
  double patience = 30;            // Seconds.
};

// Needs nothing else from the command line, and ends it.
void ListDevices() {
  PrintDevices();
  throw CLI::Success();
}

void AddArguments(CLI::App& app, Arguments& arguments) {
  AddMappingPositionals(app, arguments);
  app.add_option("--device", arguments.device,
                 "Camera, as --list names it, or a recording (default: the first camera)")
      ->type_name("URI|FILE.oni");
  app.add_flag_callback("--list", ListDevices, "Show the cameras and their modes")
      ->trigger_on_parse();
  app.add_option("--record", arguments.record,
                 "Also record all that the camera sends, for --device")
      ->type_name("FILE.oni");
  app.add_option("--record-tum", arguments.record_tum,
                 "Also record the frames that are mapped as a sequence for rgbd_tum")
      ->type_name("DIR");
  app.add_option("--duration", arguments.duration, "Stop after so many seconds")
      ->type_name("S")
      ->check(CLI::PositiveNumber);
  app.add_option("--reconnect", arguments.patience,
                 "Seconds to wait for a camera that went away (default: 30)")
      ->type_name("S")
      ->check(CLI::NonNegativeNumber);
  app.add_flag("--unregistered", arguments.unregistered,
               "Go on with a camera that cannot register depth to colour");
  app.add_flag("--device-intrinsics", arguments.device_intrinsics,
               "Focal lengths by the camera's field of view instead of the settings");
  AddMappingOptions(app, arguments,
                    "Play a recording at its own speed, as a camera; default: as fast as it can");
  app.footer(
      "Exit codes: 0 done; 1 bad input, no camera or usage; 2 done, but tracking was lost for more "
      "than 5 % of the frames; 3 the camera was lost, or the recording broke off: what was mapped "
      "is written.");
}

semslam::OpenNi2Source::Options SourceOptions(const Arguments& arguments,
                                              const semslam::Settings& settings,
                                              ProgressLine& progress) {
  semslam::OpenNi2Source::Options options;
  options.device = arguments.device;
  options.width = settings.camera.width;
  options.height = settings.camera.height;
  options.fps = static_cast<int>(std::lround(settings.fps));
  options.is_rgb = settings.is_rgb;
  options.auto_exposure = settings.auto_exposure;
  options.accept_unregistered = arguments.unregistered;
  options.play_in_real_time = arguments.realtime;
  options.recording = arguments.record;
  options.patience_seconds = arguments.patience;
  if (arguments.duration) options.duration = semslam::FromSeconds(*arguments.duration);
  options.log = [&progress](semslam::LogLevel, std::string_view module, std::string_view message) {
    progress.Report(std::string(module) + ": " + std::string(message));
  };
  options.should_stop = [] { return interrupt_requested != 0; };
  return options;
}

std::unique_ptr<semslam::TumRecorder> MakeRecorder(const Arguments& arguments,
                                                   const semslam::Settings& settings,
                                                   bool waits) {
  if (arguments.record_tum.empty()) return nullptr;
  semslam::TumRecorder::Options options;
  options.depth_factor = settings.depth_factor;
  options.waits = waits;
  return std::make_unique<semslam::TumRecorder>(arguments.record_tum, options);
}

void FinishRecording(semslam::TumRecorder& recorder, const std::filesystem::path& folder) {
  const semslam::TumRecorder::Statistics recorded = recorder.Finish();
  std::printf("recorded              %zu frames in %s, %zu left out\n", recorded.num_frames,
              folder.c_str(), recorded.num_dropped);
  if (recorded.error) throw semslam::InputError(*recorded.error);
}

RunOrigin Origin(const Arguments& arguments) {
  const std::string device = arguments.device.empty() ? "first camera" : arguments.device;
  return {.program = std::string(kName) + " " SEMSLAM_VERSION,
          .name = arguments.device.empty() ? "Live camera" : arguments.device,
          .truth = {},
          .arguments = {{"device", device}}};
}

int MapCamera(const Arguments& arguments) {
  ProgressLine progress(kName);
  semslam::Settings settings = LoadSettingsFor(arguments, progress);
  if (!arguments.record.empty())
    semslam::CheckOutputFolder(std::filesystem::absolute(arguments.record).parent_path());
  semslam::OpenNi2Source source(SourceOptions(arguments, settings, progress));
  progress.Report(source.description());
  settings = WithIntrinsics(settings, arguments.settings, source.NominalIntrinsics(),
                            arguments.device_intrinsics, progress);
  const bool is_live = !source.is_recording() || arguments.realtime;
  const auto recorder = MakeRecorder(arguments, settings, !is_live);

  RunOptions run;
  if (is_live) {
    run.live = LiveFeed{[&source] { return source.SecondsSinceArrival(); },
                        [&source] { return source.statistics().num_dropped; }};
  }
  if (recorder) run.on_frame = [&recorder](const auto& image) { recorder->Add(image); };
  const auto why_no_frames = [&source] {
    return source.failure().value_or("expected frames, but the camera sent none");
  };
  const int exit_code =
      MapFrames(arguments, settings, source, run, Origin(arguments), why_no_frames, progress);
  if (recorder) FinishRecording(*recorder, arguments.record_tum);
  if (!source.failure()) return exit_code;
  std::cerr << kName << ": " << Printable(*source.failure()) << '\n';
  return kCameraLost;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  const std::unique_ptr<CLI::App> app =
      MakeApp(kName,
              "Maps live with a depth camera: trajectory, dense cloud, segments and labelled "
              "objects.");
  AddArguments(*app, arguments);
  return RunMappingProgram(kName, [&] {
    const std::optional<int> exit_code = Parse(*app, argc, argv);
    return exit_code ? *exit_code : MapCamera(arguments);
  });
}

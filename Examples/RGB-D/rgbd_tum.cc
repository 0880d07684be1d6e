// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// Maps a recorded RGB-D sequence in the format of the TUM benchmark:
//   rgbd_tum Vocabulary/orb.voc config/TUM1.yaml SEQUENCE SEQUENCE/associations.txt --output RESULT
#include <algorithm>
#include <atomic>
#include <csignal>
#include <exception>
#include <iostream>
#include <memory>
#include <thread>

#include <opencv2/core/utility.hpp>

#include "semslam/base/error.h"
#include "semslam/config/settings.h"
#include "semslam/io/atomic_file.h"
#include "semslam/io/tum_dataset.h"
#include "semslam/pipeline/system.h"
#include "semslam/place/vocabulary.h"

#include "arguments.h"
#include "result_files.h"
#include "run_loop.h"
#include "summary.h"

namespace {

constexpr double kMaxLostShare = 0.05;  // Of the frames; more is exit code 2.

// The only thing a signal handler may touch.
volatile std::sig_atomic_t interrupt_requested = 0;

void InstallInterruptHandler() {
  struct sigaction action {};
  action.sa_handler = [](int) { interrupt_requested = 1; };
  action.sa_flags = SA_RESETHAND;  // A second Ctrl-C ends the program at once.
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

semslam::TumDataset OpenSequence(const Arguments& arguments, const semslam::Settings& settings) {
  semslam::TumDataset::Options options;
  options.width = settings.camera.width;
  options.height = settings.camera.height;
  options.depth_factor = settings.depth_factor;
  return {arguments.sequence, arguments.associations, options};
}

int MapSequence(const Arguments& arguments) {
  const semslam::Settings settings = semslam::LoadSettings(arguments.settings);
  for (const std::string& warning : settings.warnings)
    std::cerr << "rgbd_tum: warning: " << warning << '\n';
  semslam::TumDataset sequence = OpenSequence(arguments, settings);
  auto vocabulary =
      std::make_shared<const semslam::Vocabulary>(semslam::Vocabulary::Load(arguments.vocabulary));
  semslam::System::Options options;
  options.threading =
      arguments.sequential ? semslam::Threading::kInline : semslam::Threading::kWorkers;
  options.detector = MakeDetector(arguments, settings.detector);
  options.log = [](semslam::LogLevel, std::string_view, std::string_view message) {
    std::cerr << "\nrgbd_tum: " << message << '\n';
  };
  semslam::CheckOutputFolder(arguments.output);

  semslam::System system(settings, std::move(vocabulary), std::move(options));
  RunOptions run_options;
  run_options.keep_frame_times = arguments.realtime;
  run_options.fps = settings.fps;
  run_options.should_stop = [] { return interrupt_requested != 0; };
  const RunStatistics run = Run(sequence, system, run_options);
  const semslam::PointCloudMapping::Result map = system.Shutdown();
  const std::vector<std::string> errors = WriteResults(arguments.output, system, map);
  PrintSummary(run, system, map, arguments.output);
  for (const std::string& error : errors) std::cerr << "rgbd_tum: " << error << '\n';
  if (!errors.empty()) return 1;
  if (run.num_frames == 0)
    throw semslam::InputError(arguments.sequence.string() + ": no frame could be read");
  const auto num_missed = static_cast<double>(run.num_lost() + run.num_unreadable);
  return num_missed > kMaxLostShare * static_cast<double>(run.num_frames + run.num_unreadable) ? 2
                                                                                               : 0;
}

}  // namespace

int main(int argc, char** argv) {
  const ParseResult parsed = ParseArguments(argc, argv);
  if (parsed.exit_code) return *parsed.exit_code;
  InstallInterruptHandler();
  // Tracking keeps a core busy; OpenCV's own threads (the detector's) share the others.
  cv::setNumThreads(std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1));
  try {
    return MapSequence(parsed.arguments);
  } catch (const std::exception& error) {
    std::cerr << "rgbd_tum: " << error.what() << '\n';
    return 1;
  }
}

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// Maps a recorded RGB-D sequence in the format of the TUM benchmark:
//   rgbd_tum Vocabulary/orb.voc config/TUM1.yaml SEQUENCE SEQUENCE/associations.txt --output RESULT
#include <algorithm>
#include <exception>
#include <iostream>
#include <memory>
#include <string>
#include <thread>

#include <opencv2/core/utility.hpp>

#include "semslam/base/error.h"
#include "semslam/config/settings.h"
#include "semslam/io/atomic_file.h"
#include "semslam/io/tum_dataset.h"
#include "semslam/pipeline/system.h"
#include "semslam/place/vocabulary.h"

#include "arguments.h"
#include "interrupt.h"
#include "printable.h"
#include "progress_line.h"
#include "result_files.h"
#include "run_loop.h"
#include "summary.h"

namespace {

constexpr double kMaxLostShare = 0.05;  // Of the frames; more is exit code 2.

semslam::TumDataset OpenSequence(const Arguments& arguments, const semslam::Settings& settings) {
  semslam::TumDataset::Options options;
  options.width = settings.camera.width;
  options.height = settings.camera.height;
  options.depth_factor = settings.depth_factor;
  return {arguments.sequence, arguments.associations, options};
}

semslam::System::Options SystemOptions(const Arguments& arguments,
                                       const semslam::Settings& settings,
                                       ProgressLine& progress) {
  semslam::System::Options options;
  options.threading =
      arguments.sequential ? semslam::Threading::kInline : semslam::Threading::kWorkers;
  options.detector = MakeDetector(arguments, settings.detector);
  options.localization_only = arguments.localization;
  options.log = [&progress](semslam::LogLevel, std::string_view, std::string_view message) {
    progress.Report(std::string(message));
  };
  return options;
}

RunStatistics RunSequence(const Arguments& arguments,
                          double fps,
                          semslam::TumDataset& sequence,
                          semslam::System& system,
                          ProgressLine& progress) {
  RunOptions options;
  options.keep_frame_times = arguments.realtime;
  options.fps = fps;
  options.should_stop = [] { return interrupt_requested != 0; };
  RunStatistics run = Run(sequence, system, options, progress);
  if (run.num_frames > 0) return run;
  // Nothing was mapped: results of an earlier run stay as they are.
  throw semslam::InputError(run.interrupted ? "interrupted before the first frame: nothing to write"
                                            : arguments.sequence.string() +
                                                  ": expected frames, but no frame could be read");
}

bool IsTooMuchLost(const RunStatistics& run) {
  const auto num_missed = static_cast<double>(run.num_lost() + run.num_unreadable);
  return num_missed > kMaxLostShare * static_cast<double>(run.num_frames + run.num_unreadable);
}

// What is left to do after the last frame, for the one who waits.
std::string RemainingSteps(const semslam::System::Status& status) {
  std::string text = "finishing: ";
  if (status.detector_queue > 0)
    text += std::to_string(status.detector_queue) + " images to label, ";
  return text + "segments, objects, files";
}

int MapSequence(const Arguments& arguments) {
  const semslam::Settings settings = semslam::LoadSettings(arguments.settings);
  ProgressLine progress;
  for (const std::string& warning : settings.warnings) progress.Report("warning: " + warning);
  semslam::TumDataset sequence = OpenSequence(arguments, settings);
  const auto vocabulary =
      std::make_shared<const semslam::Vocabulary>(semslam::Vocabulary::Load(arguments.vocabulary));
  semslam::System::Options options = SystemOptions(arguments, settings, progress);
  semslam::CheckOutputFolder(arguments.output);

  if (!arguments.save_map.empty())
    semslam::CheckOutputFolder(std::filesystem::absolute(arguments.save_map).parent_path());

  semslam::System system(settings, vocabulary, std::move(options));
  if (!arguments.load_map.empty()) system.LoadMap(arguments.load_map);
  const RunStatistics run = RunSequence(arguments, settings.fps, sequence, system, progress);
  progress.ShowStep(RemainingSteps(system.status()));
  const semslam::PointCloudMapping::Result map =
      system.Shutdown(run.interrupted ? semslam::System::PendingLabels::kDrop
                                      : semslam::System::PendingLabels::kFinish);
  std::string error = WriteResults(arguments.output, system, map);
  if (!arguments.save_map.empty()) {
    try {
      system.SaveMap(arguments.save_map);
    } catch (const semslam::InputError& not_saved) {
      if (error.empty()) error = not_saved.what();
    }
  }
  progress.Clear();
  PrintSummary(run, system, map, arguments.output);
  if (!error.empty()) throw semslam::InputError(error);
  return IsTooMuchLost(run) ? 2 : 0;
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
    std::cerr << "rgbd_tum: " << Printable(error.what()) << '\n';
    return 1;
  }
}

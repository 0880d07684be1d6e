// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "mapping_run.h"

#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <utility>

#include "semslam/base/error.h"
#include "semslam/io/atomic_file.h"
#include "semslam/pipeline/system.h"
#include "semslam/place/vocabulary.h"

#include "interrupt.h"
#include "live_view.h"
#include "opencv_threads.h"
#include "printable.h"
#include "result_files.h"
#include "summary.h"

namespace {

constexpr double kMaxLostShare = 0.05;  // Of the frames; more is exit code 2.

// Null without --viewer. Throws if it was not built in.
std::shared_ptr<LiveState> MakeLiveState(const MappingArguments& arguments) {
  if (!arguments.viewer && !arguments.viewer_stays) return nullptr;
  if (const std::optional<std::string> why = WhyNoViewer()) throw semslam::InputError(*why);
  auto state = std::make_shared<LiveState>();
  state->StartWithLocalizationOnly(arguments.localization);
  return state;
}

semslam::System::Options SystemOptions(const MappingArguments& arguments,
                                       const semslam::Settings& settings,
                                       const std::shared_ptr<KeyframeGallery>& gallery,
                                       const std::shared_ptr<LiveState>& live,
                                       ProgressLine& progress) {
  semslam::System::Options options;
  options.threading =
      arguments.sequential ? semslam::Threading::kInline : semslam::Threading::kWorkers;
  options.detector = Watch(MakeDetector(arguments, settings.detector), gallery);
  if (live != nullptr) {
    options.detector = ShowIn(live, std::move(options.detector));
    options.on_step = [live](semslam::Step step, double seconds) {
      live->CountStep(step, seconds);
    };
  }
  options.localization_only = arguments.localization;
  options.log = [&progress](semslam::LogLevel, std::string_view, std::string_view message) {
    progress.Report(std::string(message));
  };
  return options;
}

bool IsTooMuchLost(const RunStatistics& run) {
  const auto num_missed =
      static_cast<double>(run.num_lost() + run.num_left_out + run.num_unreadable);
  return num_missed > kMaxLostShare * static_cast<double>(run.num_frames + run.num_unreadable);
}

// What is left to do after the last frame, for the one who waits.
std::string RemainingSteps(const semslam::System::Status& status) {
  std::string text = "finishing: ";
  if (status.detector_queue > 0)
    text += std::to_string(status.detector_queue) + " images to label, ";
  return text + "segments, objects, files";
}

// Which keyframes that wait for the detector still get labels.
semslam::System::PendingLabels AtTheEnd(const MappingArguments& arguments, bool interrupted) {
  if (interrupted) return semslam::System::PendingLabels::kDropAndBreakOff;
  return arguments.drop_late ? semslam::System::PendingLabels::kDrop
                             : semslam::System::PendingLabels::kFinish;
}

void ReportFailure(LiveView* view, ProgressLine& progress) {
  if (const std::optional<std::string> failure = view->TakeFailure())
    progress.Report("the run goes on without a viewer: " + *failure);
}

// A window on the system, tied to the run's loop. Null without --viewer.
std::unique_ptr<LiveView> OpenLiveView(const LiveView::Setup& setup,
                                       ProgressLine& progress,
                                       RunOptions* options) {
  if (setup.state == nullptr) return nullptr;
  auto view = std::make_unique<LiveView>(setup);
  options->before_frame = [state = setup.state, system = setup.system, view = view.get(),
                           should_stop = options->should_stop, &progress] {
    state->ObeyBetweenFrames(*system, should_stop);
    ReportFailure(view, progress);
  };
  options->on_tracked = [state = setup.state](const semslam::RgbdImagePtr& image,
                                              const semslam::Tracking::Result& result) {
    state->Show(image, result);
  };
  return view;
}

// What went wrong, if something did.
std::string WriteFiles(const MappingArguments& arguments,
                       const semslam::System& system,
                       const semslam::PointCloudMapping::Result& map) {
  std::string error = WriteResults(arguments.output, system, map);
  if (arguments.save_map.empty()) return error;
  try {
    system.SaveMap(arguments.save_map);
  } catch (const semslam::InputError& not_saved) {
    if (error.empty()) error = not_saved.what();
  }
  return error;
}

}  // namespace

int MapFrames(const MappingArguments& arguments,
              const semslam::Settings& settings,
              semslam::FrameSource& source,
              RunOptions options,
              const RunOrigin& origin,
              const std::function<std::string()>& why_no_frames,
              ProgressLine& progress) {
  const auto vocabulary =
      std::make_shared<const semslam::Vocabulary>(semslam::Vocabulary::Load(arguments.vocabulary));
  const auto gallery = std::make_shared<KeyframeGallery>();
  const std::shared_ptr<LiveState> live = MakeLiveState(arguments);
  semslam::System::Options system_options =
      SystemOptions(arguments, settings, gallery, live, progress);
  const semslam::ClassTable classes =
      system_options.detector ? system_options.detector->classes() : semslam::ClassTable();
  semslam::CheckOutputFolder(arguments.output);
  if (!arguments.save_map.empty())
    semslam::CheckOutputFolder(std::filesystem::absolute(arguments.save_map).parent_path());

  semslam::System system(settings, vocabulary, std::move(system_options));
  if (!arguments.load_map.empty()) system.LoadMap(arguments.load_map);
  options.fps = settings.fps;
  options.on_keyframe = [&](const semslam::RgbdImage& image) { gallery->Add(image); };
  options.should_stop = [] { return interrupt_requested != 0; };
  const std::unique_ptr<LiveView> window =
      OpenLiveView({.state = live,
                    .system = &system,
                    .settings = settings,
                    .classes = classes,
                    .gallery = gallery,
                    .output = arguments.output,
                    .title = origin.name + " - " + origin.program},
                   progress, &options);
  RunStatistics run = Run(source, system, options, progress);
  if (live != nullptr) live->SetEnded();
  // Nothing was mapped: results of an earlier run stay as they are.
  if (run.num_frames == 0) {
    throw semslam::InputError(
        run.interrupted ? "interrupted before the first frame: nothing to write" : why_no_frames());
  }
  progress.ShowStep(RemainingSteps(system.status()));
  const auto result = std::make_shared<const semslam::PointCloudMapping::Result>(
      system.Shutdown(AtTheEnd(arguments, run.interrupted)));
  const semslam::PointCloudMapping::Result& map = *result;
  if (window != nullptr) window->ShowResult(result);
  run.LeaveOut(system.CameraTrajectory().size());
  std::string error = WriteFiles(arguments, system, map);
  try {
    const MapView view(map);
    semslam::WriteReport(arguments.output / "report.html",
                         MakeReport(origin, arguments, settings, run, system, map, view, *gallery));
  } catch (const semslam::InputError& not_written) {
    if (error.empty()) error = not_written.what();
  }
  if (window != nullptr) ReportFailure(window.get(), progress);  // Of a run of few frames.
  progress.Clear();
  PrintSummary(run, system, map, arguments.output);
  if (window != nullptr && arguments.viewer_stays) {
    std::fflush(stdout);  // Who reads the summary need not wait for the window.
    window->WaitUntilClosed(options.should_stop);
  }
  if (!error.empty()) throw semslam::InputError(error);
  return IsTooMuchLost(run) ? 2 : 0;
}

int RunMappingProgram(const char* name, const std::function<int()>& run) {
  InstallInterruptHandler();
  LeaveACoreToTracking();
  try {
    return run();
  } catch (const std::exception& error) {
    std::cerr << name << ": " << Printable(error.what()) << '\n';
    return 1;
  }
}

semslam::Settings LoadSettingsFor(const MappingArguments& arguments, ProgressLine& progress) {
  semslam::Settings settings = semslam::LoadSettings(arguments.settings);
  for (const std::string& warning : settings.warnings) progress.Report("warning: " + warning);
  return settings;
}

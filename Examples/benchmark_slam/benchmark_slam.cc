// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// Where the time of a run goes, and how long tracking waits for the map:
//   benchmark_slam Vocabulary/orb.voc config/TUM1.yaml SEQUENCE SEQUENCE/associations.txt --runs 5
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "semslam/base/error.h"
#include "semslam/base/stopwatch.h"
#include "semslam/config/settings.h"
#include "semslam/pipeline/system.h"
#include "semslam/place/vocabulary.h"
#include "semslam/semantics/network_detector.h"

#include "measurements.h"
#include "open_sequence.h"
#include "opencv_threads.h"
#include "quantile.h"
#include "run_program.h"

namespace {

using semslam::Step;

constexpr double kLongestWait = 0.5e-3;  // Seconds that tracking may wait for the map.

struct Arguments {
  std::filesystem::path vocabulary;
  std::filesystem::path settings;
  std::filesystem::path sequence;
  std::filesystem::path associations;
  std::vector<std::string> network;
  int num_runs = 1;
  bool sequential = false;
  bool realtime = false;
};

struct NamedStep {
  Step step;
  const char* name;
};

constexpr std::array<NamedStep, 4> kTrackingSteps = {{{Step::kFeatures, "features"},
                                                      {Step::kFirstPose, "first pose"},
                                                      {Step::kLocalMap, "local map"},
                                                      {Step::kNewKeyframe, "new keyframe"}}};
constexpr std::array<NamedStep, 4> kMappingSteps = {{{Step::kTriangulation, "triangulation"},
                                                     {Step::kFusion, "fusion"},
                                                     {Step::kLocalBundle, "bundle adjustment"},
                                                     {Step::kCulling, "keyframe culling"}}};
constexpr std::array<NamedStep, 2> kLoopSteps = {
    {{Step::kLoop, "loop closing"}, {Step::kFullBundle, "full bundle adj."}}};

void AddArguments(CLI::App& app, Arguments& arguments) {
  app.add_option("VOCABULARY", arguments.vocabulary, "Visual vocabulary")->required();
  app.add_option("SETTINGS", arguments.settings, "Camera and parameters")->required();
  app.add_option("SEQUENCE", arguments.sequence, "Folder of a TUM RGB-D sequence")->required();
  app.add_option("ASSOCIATIONS", arguments.associations,
                 "File that pairs colour and depth images; - pairs them by nearest time")
      ->required();
  app.add_option("--network", arguments.network, "Darknet network that finds objects meanwhile")
      ->expected(3)
      ->type_name("CFG WEIGHTS NAMES");
  app.add_option("--runs", arguments.num_runs, "Number of runs")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  CLI::Option* sequential =
      app.add_flag("--sequential", arguments.sequential, "Everything in one thread");
  app.add_flag("--realtime", arguments.realtime, "Keep the recorded frame times")
      ->excludes(sequential);
  app.set_version_flag("--version", "benchmark_slam " SEMSLAM_VERSION);
}

// What one run took, in seconds.
struct RunTimes {
  std::vector<double> tracking;  // A frame.
  std::size_t num_tracked = 0;
  semslam::System::Status status;
};

std::vector<semslam::RgbdImagePtr> ReadImages(const Arguments& arguments,
                                              const semslam::Settings& settings) {
  semslam::TumDataset sequence = OpenSequence(arguments.sequence, arguments.associations, settings);
  std::vector<semslam::RgbdImagePtr> images;
  while (auto image = sequence.Next())
    images.push_back(std::make_shared<const semslam::RgbdImage>(*std::move(image)));
  if (images.empty())
    throw semslam::InputError(arguments.sequence.string() + ": expected frames, found none");
  return images;
}

std::unique_ptr<semslam::Detector> MakeDetector(const Arguments& arguments) {
  if (arguments.network.empty()) return nullptr;
  semslam::NetworkDetector::Options options;
  options.config = arguments.network[0];
  options.weights = arguments.network[1];
  return std::make_unique<semslam::NetworkDetector>(
      options, semslam::ClassTable::FromFile(arguments.network[2]));
}

RunTimes RunOnce(const Arguments& arguments,
                 const semslam::Settings& settings,
                 const std::shared_ptr<const semslam::Vocabulary>& vocabulary,
                 const std::vector<semslam::RgbdImagePtr>& images,
                 Measurements* measurements) {
  semslam::System::Options options;
  options.threading =
      arguments.sequential ? semslam::Threading::kInline : semslam::Threading::kWorkers;
  options.detector = MakeDetector(arguments);
  options.on_step = [=](Step step, double seconds) { measurements->AddStep(step, seconds); };
  options.on_map_wait = [=](double seconds) { measurements->AddWait(seconds); };
  semslam::System system(settings, vocabulary, std::move(options));
  RunTimes run;
  const auto start = std::chrono::steady_clock::now();
  for (const semslam::RgbdImagePtr& image : images) {
    if (arguments.realtime)
      std::this_thread::sleep_until(start +
                                    std::chrono::nanoseconds(image->time - images.front()->time));
    const semslam::Stopwatch tracking;
    const semslam::Tracking::Result result = system.TrackRGBD(image);
    run.tracking.push_back(tracking.Seconds());
    if (result.state == semslam::TrackingState::kTracking) ++run.num_tracked;
  }
  system.Shutdown();
  run.status = system.status();
  return run;
}

// Undisturbed by other threads.
std::vector<double> TimeExtraction(const semslam::Settings& settings,
                                   const std::vector<semslam::RgbdImagePtr>& images) {
  const semslam::FrameBuilder builder(settings.orb, semslam::PinholeCamera(settings.camera),
                                      settings.bf);
  std::vector<double> seconds;
  for (const semslam::RgbdImagePtr& image : images) {
    const semslam::Stopwatch stopwatch;
    builder.Build(*image);
    seconds.push_back(stopwatch.Seconds());
  }
  return seconds;
}

double Sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

void PrintLine(const char* name, const std::vector<double>& seconds, double total_seconds) {
  std::printf("  %-20s %6zu %9.2f %9.2f %9.2f %7.1f %%\n", name, seconds.size(),
              1e3 * Quantile(seconds, 0.5), 1e3 * Quantile(seconds, 0.95),
              1e3 * Quantile(seconds, 1.0),
              total_seconds > 0 ? 100 * Sum(seconds) / total_seconds : 0.0);
}

template <std::size_t kCount>
double PrintSteps(const char* title,
                  const std::array<NamedStep, kCount>& steps,
                  const Measurements& measurements) {
  double total = 0;
  for (const NamedStep& step : steps) total += Sum(measurements.StepTimes(step.step));
  std::printf("%s\n", title);
  for (const NamedStep& step : steps)
    PrintLine(step.name, measurements.StepTimes(step.step), total);
  return total;
}

void PrintWaits(const Measurements& measurements) {
  const std::vector<double> waits = measurements.TrackingWaits();
  const std::vector<double> others = measurements.OtherWaits();
  const auto num_long = std::count_if(waits.begin(), waits.end(),
                                      [](double seconds) { return seconds > kLongestWait; });
  std::printf(
      "map lock              tracking asked %zu times and waited: p99 %.3f ms, p99.9 %.3f "
      "ms, longest %.3f ms\n",
      waits.size(), 1e3 * Quantile(waits, 0.99), 1e3 * Quantile(waits, 0.999),
      1e3 * Quantile(waits, 1.0));
  if (num_long == 0) {
    std::printf("                      tracking never waited more than %.1f ms\n",
                1e3 * kLongestWait);
  } else {
    std::printf("                      tracking waited more than %.1f ms %td times\n",
                1e3 * kLongestWait, num_long);
  }
  std::printf("                      other threads waited: longest %.3f ms\n",
              1e3 * Quantile(others, 1.0));
}

int Run(const Arguments& arguments) {
  const semslam::Settings settings = semslam::LoadSettings(arguments.settings);
  const semslam::Stopwatch loading;
  const auto vocabulary =
      std::make_shared<const semslam::Vocabulary>(semslam::Vocabulary::Load(arguments.vocabulary));
  const double loading_seconds = loading.Seconds();
  const std::vector<semslam::RgbdImagePtr> images = ReadImages(arguments, settings);
  LeaveACoreToTracking();
  std::printf("vocabulary            %zu words, loaded in %.1f ms\n", vocabulary->num_words(),
              1e3 * loading_seconds);
  const std::vector<double> extraction = TimeExtraction(settings, images);
  std::printf("features alone        %d: median %.2f ms, p95 %.2f ms\n", settings.orb.num_features,
              1e3 * Quantile(extraction, 0.5), 1e3 * Quantile(extraction, 0.95));

  Measurements measurements;
  std::vector<double> tracking;
  for (int i = 0; i < arguments.num_runs; ++i) {
    const RunTimes run = RunOnce(arguments, settings, vocabulary, images, &measurements);
    tracking.insert(tracking.end(), run.tracking.begin(), run.tracking.end());
    std::printf(
        "run %-3d               %zu of %zu frames tracked, median %.2f ms, p95 %.2f ms, "
        "%zu keyframes, %zu landmarks, %zu loops\n",
        i + 1, run.num_tracked, images.size(), 1e3 * Quantile(run.tracking, 0.5),
        1e3 * Quantile(run.tracking, 0.95), run.status.num_keyframes, run.status.num_landmarks,
        run.status.num_loops);
  }
  std::printf("\n%-22s %6s %9s %9s %9s %9s\n", "step", "times", "median ms", "p95 ms", "max ms",
              "share");
  PrintSteps("tracking, a frame", kTrackingSteps, measurements);
  PrintLine("all", tracking, Sum(tracking));
  PrintSteps("mapping, a keyframe", kMappingSteps, measurements);
  PrintSteps("loops", kLoopSteps, measurements);
  std::printf("\n");
  PrintWaits(measurements);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return RunProgram<Arguments>("benchmark_slam",
                               "Where the time of a SLAM run goes, and how long tracking waits.",
                               argc, argv, AddArguments, Run);
}

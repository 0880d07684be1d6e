// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "run_report.h"

#include <ctime>
#include <map>
#include <thread>
#include <utility>

#include "semslam/base/error.h"
#include "semslam/eval/trajectory_error.h"

#include "format_line.h"
#include "memory_use.h"
#include "quantile.h"
#include "result_files.h"

namespace {

using semslam::ReportData;
using semslam::ReportFact;

std::string Count(std::size_t count) { return std::to_string(count); }

std::string Join(const std::vector<std::string>& words, const char* separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

double PathLength(const semslam::Trajectory& trajectory) {
  double length = 0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    length +=
        (trajectory[i].T_world_camera.translation - trajectory[i - 1].T_world_camera.translation)
            .norm();
  }
  return length;
}

void AddAccuracy(const std::filesystem::path& truth_file, ReportData* report) {
  if (truth_file.empty() || !std::filesystem::exists(truth_file)) return;
  semslam::TrajectoryError error;
  try {
    error = semslam::EvaluateTrajectory(semslam::ReadTrajectory(truth_file), report->trajectory);
  } catch (const semslam::InputError& failure) {
    report->notes.push_back(std::string("Not compared with the truth: ") + failure.what());
    return;
  }
  const auto& ate = error.absolute;
  semslam::ReportAccuracy accuracy;
  accuracy.facts = {{"ATE, root mean square", Line("%.1f mm", 1e3 * ate.rmse)},
                    {"ATE, mean", Line("%.1f mm", 1e3 * ate.mean)},
                    {"ATE, median", Line("%.1f mm", 1e3 * ate.median)},
                    {"ATE, largest", Line("%.1f mm", 1e3 * ate.max)},
                    {"poses compared", Line("%d of %d", error.num_pairs, error.num_estimates)},
                    {"true path", Line("%.2f m", error.path_length)}};
  if (error.num_relative_pairs > 0) {
    accuracy.facts.push_back(
        {"RPE over 1 s, translation", Line("%.1f mm", 1e3 * error.relative_translation_rmse)});
    accuracy.facts.push_back(
        {"RPE over 1 s, rotation", Line("%.2f deg", error.relative_rotation_rmse_degrees)});
  }
  const semslam::Rigid3 T_estimate_truth = error.T_truth_estimate.Inverse();
  for (const auto& pose : error.poses)
    accuracy.poses.push_back({pose.time, T_estimate_truth * pose.p_truth, pose.distance});
  report->highlights.push_back({"trajectory error (ATE)", accuracy.facts.front().value});
  report->accuracy = std::move(accuracy);
}

void AddCounts(const RunStatistics& run,
               const semslam::System& system,
               const semslam::PointCloudMapping::Result& map,
               ReportData* report) {
  const semslam::System::Status status = system.status();
  report->highlights.push_back({"keyframes", Count(status.num_keyframes)});
  report->highlights.push_back(
      {"map points", Line("%.0f k", 1e-3 * static_cast<double>(map.cloud.size()))});
  report->highlights.push_back({"objects", Count(map.semantics.objects.size())});
  report->facts = {{"frames tracked", Count(run.num_tracked)},
                   {"frames lost", Count(run.num_lost())},
                   {"frames left out, apart from the map", Count(run.num_left_out)},
                   {"frames unreadable", Count(run.num_unreadable)},
                   {"camera path", Line("%.2f m", PathLength(report->trajectory))},
                   {"keyframes", Count(status.num_keyframes)},
                   {"landmarks", Count(status.num_landmarks)},
                   {"rolling shutter", Line("%.1f ms", 1e3 * status.readout_seconds)},
                   {"loops closed", Count(status.num_loops)},
                   {"pieces of the map joined", Count(status.num_joins)},
                   {"place found again after a loss", Count(status.num_relocalizations)},
                   {"map points", Count(map.cloud.size())},
                   {"distance of map points", Line("%.0f mm", 1e3 * map.cloud.voxel_size)},
                   {"segments", Count(map.segmentation.segments.size())},
                   {"objects", Count(map.semantics.objects.size())}};
  if (!system.has_detector()) return;
  const semslam::DetectorThread::Statistics detector = system.detector_statistics();
  report->facts.push_back(
      {"images labelled", Line("%zu of %zu keyframes", detector.num_done, detector.num_submitted)});
}

void AddNotes(const RunStatistics& run, const semslam::System& system, ReportData* report) {
  std::vector<std::string>& notes = report->notes;
  if (run.interrupted) notes.emplace_back("The run was interrupted before the last frame.");
  if (run.num_lost() > 0)
    notes.push_back(
        Line("Tracking was lost for %zu of %zu frames.", run.num_lost(), run.num_frames));
  if (run.num_unreadable > 0)
    notes.push_back(Line("%zu frames could not be read and were skipped.", run.num_unreadable));
  if (!system.has_detector()) {
    notes.emplace_back("No detector was given: the map has geometry and segments, no classes.");
    return;
  }
  const semslam::DetectorThread::Statistics detector = system.detector_statistics();
  if (detector.num_failed > 0) {
    notes.push_back(Count(detector.num_failed) +
                    " images were not labelled: " + detector.first_error);
  }
}

std::string Now() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[64];
  std::strftime(text, sizeof(text), "%Y-%m-%d %H:%M %Z", &local);
  return text;
}

semslam::ReportSpeed MakeSpeed(const RunStatistics& run,
                               const semslam::System& system,
                               const semslam::PointCloudMapping::Result& map) {
  semslam::ReportSpeed speed;
  const std::vector<double>& tracking = run.tracking_milliseconds;
  const double rate = run.seconds > 0 ? static_cast<double>(run.num_frames) / run.seconds : 0;
  speed.highlight = ReportFact{"tracking, median", Line("%.1f ms", Quantile(tracking, 0.5))};
  speed.facts = {{"frames in", Line("%.1f s, %.1f a second", run.seconds, rate)},
                 {"tracking, median", Line("%.1f ms", Quantile(tracking, 0.5))},
                 {"tracking, 95 % below", Line("%.1f ms", Quantile(tracking, 0.95))},
                 {"dense map, a keyframe", Line("%.1f ms", map.integration_milliseconds)},
                 {"segmentation, last", Line("%.0f ms", map.segmentation_milliseconds)},
                 {"fusion, last", Line("%.0f ms", map.fusion_milliseconds)}};
  if (system.has_detector()) {
    speed.facts.push_back(
        {"detector, an image", Line("%.1f ms", system.detector_statistics().mean_milliseconds)});
    speed.facts.push_back({"images that waited for it",
                           Line("%zu at most", system.detector_statistics().longest_queue)});
  }
  if (run.num_late)
    speed.facts.push_back(
        {"late by over a frame", Line("%zu of %zu frames", *run.num_late, run.num_frames)});
  if (run.live) {
    const std::vector<double>& latency = run.live->latency_milliseconds;
    speed.facts.push_back({"frames dropped", Count(run.live->num_dropped)});
    speed.facts.push_back({"frame to pose, median", Line("%.1f ms", Quantile(latency, 0.5))});
    speed.facts.push_back({"frame to pose, 95 % below", Line("%.1f ms", Quantile(latency, 0.95))});
  }
  speed.facts.push_back({"peak memory", Line("%.0f MB", PeakMegabytes())});
  speed.facts.push_back({"processor cores", Count(std::thread::hardware_concurrency())});
  speed.facts.push_back({"written", Now()});
  speed.tracking_milliseconds = tracking;
  for (const QueueSample& sample : run.queues) {
    speed.queues.push_back(
        {sample.num_frames, sample.mapping, sample.loop, sample.dense, sample.detector});
  }
  return speed;
}

// Without where the results go: the page lies there.
std::vector<ReportFact> Options(const RunOrigin& origin, const MappingArguments& arguments) {
  std::vector<ReportFact> options = origin.arguments;
  options.push_back({"vocabulary", arguments.vocabulary.string()});
  options.push_back({"settings", arguments.settings.string()});
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) options.push_back({name, value});
  };
  add("--network", Join(arguments.network, " "));
  add("--detections", arguments.detections.string());
  add("--classes", Join(arguments.classes, ", "));
  add("--score", arguments.score ? Line("%g", *arguments.score) : "");
  add("--load-map", arguments.load_map.string());
  for (const auto& [name, is_set] : {std::pair{"--localization", arguments.localization},
                                     {"--no-semantics", arguments.no_semantics},
                                     {"--sequential", arguments.sequential},
                                     {"--realtime", arguments.realtime}})
    add(name, is_set ? "yes" : "");
  return options;
}

std::vector<semslam::ReportKeyframe> Keyframes(const semslam::System& system,
                                               const KeyframeGallery& gallery) {
  std::vector<semslam::ReportKeyframe> keyframes;
  std::map<semslam::TimeNs, KeyframeGallery::Picture> pictures = gallery.Copy();
  for (const auto& pose : system.KeyframeTrajectory()) {
    const auto picture = pictures.find(pose.time);
    if (picture == pictures.end()) continue;
    keyframes.push_back({pose.time, pose.T_world_camera, std::move(picture->second.jpeg),
                         std::move(picture->second.detections)});
  }
  return keyframes;
}

}  // namespace

ReportData MakeReport(const RunOrigin& origin,
                      const MappingArguments& arguments,
                      const semslam::Settings& settings,
                      const RunStatistics& run,
                      const semslam::System& system,
                      const semslam::PointCloudMapping::Result& map,
                      const MapView& view,
                      const KeyframeGallery& gallery) {
  ReportData report;
  report.title = origin.name;
  report.program = origin.program;
  report.trajectory = ToTrajectory(system.CameraTrajectory());
  report.highlights.push_back(
      {"frames tracked", Line("%zu / %zu", run.num_tracked, run.num_frames)});
  AddNotes(run, system, &report);
  AddAccuracy(origin.truth, &report);
  AddCounts(run, system, map, &report);
  report.options = Options(origin, arguments);
  report.settings_text = settings.text;
  report.speed = MakeSpeed(run, system, map);
  report.keyframes = Keyframes(system, gallery);
  report.camera = settings.camera;
  report.map = view.view();
  return report;
}

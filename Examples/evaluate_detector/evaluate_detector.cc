// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
// Compares what a network finds in rendered clips with what they show:
//   evaluate_detector CLIP... --network CFG WEIGHTS NAMES
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>

#include "semslam/base/error.h"
#include "semslam/base/stopwatch.h"
#include "semslam/config/settings.h"
#include "semslam/eval/detection_score.h"
#include "semslam/eval/true_boxes.h"
#include "semslam/io/instances_io.h"
#include "semslam/io/trajectory_io.h"
#include "semslam/semantics/network_detector.h"

#include "format_line.h"
#include "network_argument.h"
#include "open_sequence.h"
#include "quantile.h"
#include "run_program.h"

namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::vector<fs::path> clips;
  std::vector<std::string> network;
  std::size_t every = 1;
  int threads = 0;
  // Far below what is worth acting on: average precision looks at the whole curve.
  float score_threshold = 0.02F;
  int input_size = 0;
};

struct Findings {
  std::vector<semslam::ScoredPicture> pictures;
  std::vector<double> milliseconds;  // For each.
};

void AddArguments(CLI::App& app, Arguments& arguments) {
  app.add_option("CLIP", arguments.clips, "Folders that render_clip wrote")->required();
  app.add_option("--network", arguments.network,
                 "Network that is looked at: of Darknet, or FILE.onnx NAMES")
      ->expected(2, 3)
      ->required()
      ->type_name("CFG WEIGHTS NAMES");
  app.add_option("--every", arguments.every, "Look at every so many pictures only")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--score", arguments.score_threshold, "Drop detections below")
      ->capture_default_str();
  app.add_option("--input-size", arguments.input_size,
                 "Pixels, a multiple of 32; 0: as the network's file says")
      ->capture_default_str();
  app.add_option("--threads", arguments.threads, "Of the network; 0: one per core")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.set_version_flag("--version", "evaluate_detector " SEMSLAM_VERSION);
}

cv::Mat ReadLabels(const fs::path& path, const cv::Size& size) {
  cv::Mat labels = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
  if (labels.type() != CV_16UC1 || labels.size() != size) {
    throw semslam::InputError(path.string() +
                              ": expected a 16-bit label image of the picture's size");
  }
  return labels;
}

const semslam::Rigid3& PoseAt(const semslam::Trajectory& trajectory,
                              semslam::TimeNs time,
                              const fs::path& clip) {
  const auto pose = std::lower_bound(
      trajectory.begin(), trajectory.end(), time,
      [](const semslam::TimedPose& candidate, semslam::TimeNs t) { return candidate.time < t; });
  if (pose == trajectory.end() || pose->time != time) {
    throw semslam::InputError((clip / "groundtruth.txt").string() +
                              ": expected a pose for every picture, found none at " +
                              semslam::FormatTime(time));
  }
  return pose->T_world_camera;
}

void LookAt(const fs::path& clip,
            std::size_t every,
            semslam::Detector& detector,
            Findings& findings) {
  const semslam::Settings settings = semslam::LoadSettings(clip / "settings.yaml");
  const auto instances = semslam::ReadInstances(clip / "instances.json");
  const auto trajectory = semslam::ReadTrajectory(clip / "groundtruth.txt");
  const auto sequence = OpenSequence(clip, clip / "associations.txt", settings);
  const semslam::PinholeCamera camera(settings.camera);
  for (std::size_t i = 0; i < sequence.entries().size(); i += every) {
    const auto& entry = sequence.entries()[i];
    const semslam::RgbdImage image = sequence.Read(entry);
    const cv::Mat labels =
        ReadLabels(clip / "labels" / entry.color_path.filename(), image.color.size());
    const semslam::Stopwatch watch;
    std::vector<semslam::Detection> found = detector.Detect(image);
    findings.milliseconds.push_back(watch.Milliseconds());
    findings.pictures.push_back(
        {semslam::FindTrueBoxes(labels, instances, detector.classes(),
                                PoseAt(trajectory, entry.color_time, clip), camera),
         std::move(found)});
  }
}

std::string Table(const Findings& findings, const semslam::ClassTable& classes) {
  const semslam::DetectionScore score = semslam::ScoreDetections(findings.pictures, classes.size());
  std::string table = Line("%-16s %8s %8s\n", "class", "objects", "AP50");
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const auto& of_class = score.classes[i];
    if (of_class.num_true == 0 && of_class.num_found == 0) continue;
    const std::string precision =
        of_class.num_true == 0 ? "-" : Line("%.3f", of_class.average_precision);
    table += Line("%-16s %8zu %8s\n", classes.name(static_cast<int>(i)).c_str(), of_class.num_true,
                  precision.c_str());
  }
  table += Line("%-25s %8.3f\n", "mean", score.MeanAveragePrecision());
  table += Line("%zu pictures, median %.1f ms, 95 %% within %.1f ms\n", findings.pictures.size(),
                Quantile(findings.milliseconds, 0.5), Quantile(findings.milliseconds, 0.95));
  return table;
}

int Run(const Arguments& arguments) {
  if (arguments.threads > 0) cv::setNumThreads(arguments.threads);
  semslam::NetworkOptions options;
  const fs::path names = TakeNetwork(arguments.network, options);
  options.input_size = arguments.input_size;
  options.score_threshold = arguments.score_threshold;
  options.min_class_score = std::min(options.min_class_score, options.score_threshold);
  const auto detector =
      std::make_unique<semslam::NetworkDetector>(options, semslam::ClassTable::FromFile(names));
  Findings findings;
  for (const fs::path& clip : arguments.clips) {
    LookAt(clip, arguments.every, *detector, findings);
  }
  std::cout << Table(findings, detector->classes());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return RunProgram<Arguments>(
      "evaluate_detector",
      "Says how well a network finds the objects of rendered clips (average precision at an "
      "overlap of 0.5) and how long a picture takes it.",
      argc, argv, AddArguments, Run);
}

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "arguments.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "semslam/base/error.h"
#include "semslam/io/detection_recorder.h"
#include "semslam/semantics/network_detector.h"
#include "semslam/semantics/recorded_detector.h"

#include "network_argument.h"
#include "printable.h"

namespace {

constexpr const char* kNamesInDetections = "classes.names";

// Empty if the text is a score; nan is none.
std::string CheckScore(const std::string& text) {
  double score = 0;
  const bool is_score = CLI::detail::lexical_cast(text, score) && score > 0 && score <= 1;
  return is_score ? "" : "expected a number above 0 and up to 1, found " + text;
}

// Leaves what the descriptions say anyway (required, excludes) out of the help.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string value = option->get_positional() ? "" : option->get_type_name();
    return value.empty() ? "" : " " + value;
  }
};

}  // namespace

std::unique_ptr<CLI::App> MakeApp(const std::string& name, const std::string& description) {
  auto app = std::make_unique<CLI::App>(description, name);
  app->set_version_flag("--version", name + " " SEMSLAM_VERSION);
  app->formatter(std::make_shared<HelpFormatter>());
  return app;
}

void AddMappingPositionals(CLI::App& app, MappingArguments& arguments) {
  app.add_option("VOCABULARY", arguments.vocabulary,
                 "Visual vocabulary: Vocabulary/orb.voc, or ORB-SLAM2's ORBvoc.txt")
      ->required();
  app.add_option("SETTINGS", arguments.settings, "Camera and parameters: config/TUM1.yaml, ...")
      ->required();
}

void AddMappingOptions(CLI::App& app, MappingArguments& arguments, const std::string& realtime) {
  app.add_option("--output", arguments.output, "Folder for the results (default: here)")
      ->type_name("DIR");
  CLI::Option* network =
      app.add_option("--network", arguments.network,
                     "Network that finds the objects: of Darknet, or FILE.onnx NAMES")
          ->expected(2, 3)
          ->type_name("CFG WEIGHTS NAMES");
  CLI::Option* detections =
      app.add_option(
             "--detections", arguments.detections,
             "Instead of a network: recorded detections, a file (YOLO text or JSON) an image, and "
             "classes.names")
          ->type_name("DIR")
          ->excludes(network);
  app.add_option("--classes", arguments.classes, "Classes to put into the map (default: all)")
      ->type_name("cup,keyboard,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--score", arguments.score, "Least score of a detection (default: 0.25)")
      ->type_name("S")
      ->check(CheckScore);
  CLI::Option* save_detections =
      app.add_flag("--save-detections", arguments.save_detections,
                   "Write the keyframes with their boxes, and what --detections reads, into the "
                   "folder detections of the results");
  app.add_flag("--drop-late", arguments.drop_late,
               "At the end, leave keyframes that still wait for the detector without labels");
  app.add_flag("--no-semantics", arguments.no_semantics, "Neither detector nor classes")
      ->excludes(network)
      ->excludes(detections)
      ->excludes(save_detections);
  CLI::Option* load =
      app.add_option("--load-map", arguments.load_map, "Go on from a map that --save-map wrote")
          ->type_name("FILE");
  CLI::Option* save =
      app.add_option("--save-map", arguments.save_map, "Write a map that --load-map can go on from")
          ->type_name("FILE");
  app.add_flag("--localization", arguments.localization,
               "Only find the camera in the loaded map, which stays as it is")
      ->needs(load)
      ->excludes(save);
  CLI::Option* sequential = app.add_flag("--sequential", arguments.sequential,
                                         "Everything in one thread: two runs write the same bytes");
  app.add_flag("--realtime", arguments.realtime, realtime)->excludes(sequential);
  app.add_flag("--viewer", arguments.viewer,
               "Show the run in a window; closing it does not end the run");
  app.add_flag("--viewer-stays", arguments.viewer_stays,
               "The same, and keep the window after the run until it is closed");
}

namespace {

// Null for none.
std::unique_ptr<semslam::Detector> ChosenDetector(const MappingArguments& arguments,
                                                  const semslam::DetectorSettings& settings) {
  const std::vector<std::string>& interest =
      arguments.classes.empty() ? settings.classes : arguments.classes;
  const auto score = static_cast<float>(arguments.score.value_or(settings.score_threshold));
  if (!arguments.detections.empty()) {
    semslam::RecordedDetector::Options options;
    options.folder = arguments.detections;
    options.score_threshold = score;
    return std::make_unique<semslam::RecordedDetector>(
        options, semslam::ClassTable::FromFile(arguments.detections / kNamesInDetections)
                     .WithInterest(interest));
  }
  semslam::NetworkOptions options;
  std::filesystem::path names = settings.names;
  options.config = settings.config;
  options.weights = settings.weights;
  if (!arguments.network.empty()) names = TakeNetwork(arguments.network, options);
  if (options.config.empty()) {
    if (interest.empty()) return nullptr;
    throw semslam::InputError(
        "classes were given, but no network: expected --network CFG WEIGHTS NAMES");
  }
  options.score_threshold = score;
  options.min_class_score = std::min(options.min_class_score, score);
  options.nms_threshold = static_cast<float>(settings.nms_threshold);
  options.input_size = settings.input_size;
  options.batch_size = settings.batch_size;
  options.letterbox = settings.letterbox;
  options.backend = settings.backend;
  options.target = settings.target;
  return std::make_unique<semslam::NetworkDetector>(
      options, semslam::ClassTable::FromFile(names).WithInterest(interest));
}

}  // namespace

std::optional<int> Parse(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return app.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    std::cerr << app.get_name() << ": " << Printable(error.what()) << " (--help shows the usage)\n";
    return 1;
  }
  return std::nullopt;
}

std::unique_ptr<semslam::Detector> MakeDetector(const MappingArguments& arguments,
                                                const semslam::DetectorSettings& settings) {
  if (arguments.no_semantics) return nullptr;
  std::unique_ptr<semslam::Detector> detector = ChosenDetector(arguments, settings);
  if (!arguments.save_detections) return detector;
  if (detector == nullptr) {
    throw semslam::InputError(
        "--save-detections: nothing detects: expected --network or --detections");
  }
  const std::filesystem::path folder = arguments.output / "detections";
  std::error_code ignored;  // Then they are two.
  if (std::filesystem::equivalent(folder, arguments.detections, ignored)) {
    throw semslam::InputError("--save-detections: " + folder.string() +
                              " would be overwritten while it is read by --detections");
  }
  return std::make_unique<semslam::DetectionRecorder>(std::move(detector), folder);
}

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
// Compares a map with the truth of the rendered clip it was made from:
//   evaluate_map CLIP RESULT
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "semslam/eval/clip_truth.h"
#include "semslam/eval/map_evaluation.h"
#include "semslam/io/atomic_file.h"
#include "semslam/io/cloud_io.h"

#include "map_report.h"
#include "printable.h"

namespace {

struct Arguments {
  std::string clip;
  std::string result;
  std::string json;
  std::string labelled_cloud;
  semslam::MapEvaluationOptions options;
};

void AddArguments(CLI::App& app, Arguments& arguments) {
  app.add_option("CLIP", arguments.clip, "Folder that render_clip wrote")->required();
  app.add_option("RESULT", arguments.result, "Output folder of rgbd_tum")->required();
  app.add_option("--classes", arguments.options.classes,
                 "Classes to evaluate (default: those that clip and result share)")
      ->delimiter(',');
  app.add_option("--json", arguments.json, "File to write the measures to");
  app.add_option(
      "--labelled-cloud", arguments.labelled_cloud,
      "PCD file to write the map's points to, with their true surface as label (0: none)");
  app.set_version_flag("--version", "evaluate_map " SEMSLAM_VERSION);
}

void Run(const Arguments& arguments) {
  const semslam::ClipTruth truth = semslam::ReadClipTruth(arguments.clip);
  const semslam::MapResult result = semslam::ReadMapResult(arguments.result);
  const semslam::MapEvaluation evaluation = semslam::EvaluateMap(truth, result, arguments.options);
  if (!arguments.json.empty()) {
    semslam::WriteFileAtomically(arguments.json, MapJson(evaluation, truth));
  }
  if (!arguments.labelled_cloud.empty()) {
    semslam::WritePcd(arguments.labelled_cloud,
                      {.positions = result.positions, .labels = evaluation.region_of_point});
  }
  std::cout << MapTable(evaluation, truth);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Arguments arguments;
    CLI::App app(
        "Compares a map with the truth of the rendered clip it was made from: trajectory, surface, "
        "segments, class labels, objects.");
    AddArguments(app, arguments);
    try {
      app.parse(argc, argv);
    } catch (const CLI::Success& help_or_version) {
      return app.exit(help_or_version);
    } catch (const CLI::ParseError& error) {
      std::cerr << "evaluate_map: " << Printable(error.what()) << " (--help shows the usage)\n";
      return 1;
    }
    Run(arguments);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "evaluate_map: " << Printable(error.what()) << '\n';
    return 1;
  }
}

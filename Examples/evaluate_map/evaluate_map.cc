// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
// Compares a map with the truth of the rendered clip it was made from:
//   evaluate_map CLIP RESULT
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "semslam/eval/clip_truth.h"
#include "semslam/eval/map_evaluation.h"
#include "semslam/io/atomic_file.h"
#include "semslam/io/cloud_io.h"

#include "baselines.h"
#include "map_report.h"
#include "run_program.h"

namespace {

struct Arguments {
  std::string clip;
  std::string result;
  std::string json;
  std::string labelled_cloud;
  std::string detections;
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
  app.add_option("--detections", arguments.detections,
                 "Also print what simpler ways make of these detections: painted boxes, votes by "
                 "point, votes by segment (DIR of rgbd_tum --save-detections, or of the clip)")
      ->type_name("DIR");
  app.set_version_flag("--version", "evaluate_map " SEMSLAM_VERSION);
}

int Run(const Arguments& arguments) {
  const semslam::ClipTruth truth = semslam::ReadClipTruth(arguments.clip);
  const semslam::MapResult result = semslam::ReadMapResult(arguments.result);
  const semslam::MapEvaluation evaluation = semslam::EvaluateMap(truth, result, arguments.options);
  std::vector<Baseline> baselines;
  if (!arguments.detections.empty()) {
    baselines = EvaluateBaselines({arguments.clip, arguments.result, arguments.detections}, truth,
                                  result, evaluation, arguments.options);
  }
  if (!arguments.json.empty()) {
    semslam::WriteFileAtomically(arguments.json, MapJson(evaluation, truth, baselines));
  }
  if (!arguments.labelled_cloud.empty()) {
    semslam::WritePcd(arguments.labelled_cloud,
                      {.positions = result.positions, .labels = evaluation.region_of_point});
  }
  std::cout << MapTable(evaluation, truth, baselines);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return RunProgram<Arguments>(
      "evaluate_map",
      "Compares a map with the truth of the rendered clip it was made from: trajectory, surface, "
      "segments, class labels, objects.",
      argc, argv, AddArguments, Run);
}

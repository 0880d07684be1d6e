// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
// Compares an estimated trajectory with the true one, as the TUM RGB-D benchmark does:
//   evaluate_trajectory groundtruth.txt CameraTrajectory.txt
#include <cstdio>
#include <iostream>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "semslam/eval/trajectory_error.h"
#include "semslam/io/trajectory_io.h"

#include "run_program.h"

namespace {

void PrintText(const semslam::TrajectoryError& error) {
  const auto& ate = error.absolute;
  std::printf("pairs                 %d of %d estimated poses, true path %.2f m\n", error.num_pairs,
              error.num_estimates, error.path_length);
  std::printf("ATE                   rmse %.4f m  mean %.4f  median %.4f  max %.4f\n", ate.rmse,
              ate.mean, ate.median, ate.max);
  if (error.num_relative_pairs == 0) {
    std::printf("RPE over 1 s          no two poses 1 s apart\n");
    return;
  }
  std::printf("RPE over 1 s          translation rmse %.4f m  rotation rmse %.3f deg  (%d pairs)\n",
              error.relative_translation_rmse, error.relative_rotation_rmse_degrees,
              error.num_relative_pairs);
}

void PrintJson(const semslam::TrajectoryError& error) {
  const auto& ate = error.absolute;
  const nlohmann::ordered_json json = {
      {"num_estimates", error.num_estimates},
      {"num_pairs", error.num_pairs},
      {"path_length_m", error.path_length},
      {"ate_m", {{"rmse", ate.rmse}, {"mean", ate.mean}, {"median", ate.median}, {"max", ate.max}}},
      {"rpe_1s",
       {{"num_pairs", error.num_relative_pairs},
        {"translation_rmse_m", error.relative_translation_rmse},
        {"rotation_rmse_deg", error.relative_rotation_rmse_degrees}}}};
  std::cout << json.dump(2) << '\n';
}

struct Arguments {
  std::string truth;
  std::string estimate;
  bool as_json = false;
};

void AddArguments(CLI::App& app, Arguments& arguments) {
  app.add_option("GROUNDTRUTH", arguments.truth, "True trajectory: t tx ty tz qx qy qz qw")
      ->required();
  app.add_option("ESTIMATE", arguments.estimate, "Estimated trajectory, same format")->required();
  app.add_flag("--json", arguments.as_json, "Print JSON");
  app.set_version_flag("--version", "evaluate_trajectory " SEMSLAM_VERSION);
}

int Run(const Arguments& arguments) {
  const semslam::Trajectory truth = semslam::ReadTrajectory(arguments.truth);
  const semslam::Trajectory estimate = semslam::ReadTrajectory(arguments.estimate);
  const semslam::TrajectoryError error = semslam::EvaluateTrajectory(truth, estimate);
  arguments.as_json ? PrintJson(error) : PrintText(error);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return RunProgram<Arguments>("evaluate_trajectory",
                               "Absolute and relative error of a trajectory in the TUM format.",
                               argc, argv, AddArguments, Run);
}

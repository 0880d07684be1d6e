// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// Maps a recorded RGB-D sequence in the format of the TUM benchmark:
//   rgbd_tum Vocabulary/orb.voc config/TUM1.yaml SEQUENCE SEQUENCE/associations.txt --output RESULT
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "semslam/config/settings.h"

#include "arguments.h"
#include "mapping_run.h"
#include "open_sequence.h"
#include "progress_line.h"
#include "run_loop.h"

namespace {

constexpr const char* kName = "rgbd_tum";

struct Arguments : MappingArguments {
  std::filesystem::path sequence;
  std::filesystem::path associations;  // "-": by nearest time.
};

void AddArguments(CLI::App& app, Arguments& arguments) {
  AddMappingPositionals(app, arguments);
  app.add_option("SEQUENCE", arguments.sequence, "Folder of a TUM RGB-D sequence")->required();
  app.add_option(
         "ASSOCIATIONS", arguments.associations,
         "File that pairs colour and depth images; - pairs them by nearest time within 20 ms")
      ->required();
  AddMappingOptions(app, arguments,
                    "Keep the recorded frame times instead of going as fast as it can");
  app.footer(
      "Exit codes: 0 done; 1 bad input or usage; 2 done, but tracking was lost for more than 5 % "
      "of the frames.");
}

RunOrigin Origin(const Arguments& arguments) {
  const std::filesystem::path folder =
      std::filesystem::absolute(arguments.sequence / "").lexically_normal().parent_path();
  return {.program = std::string(kName) + " " SEMSLAM_VERSION,
          .name = folder.filename().string(),
          .truth = folder / "groundtruth.txt",
          .arguments = {{"sequence", arguments.sequence.string()},
                        {"associations", arguments.associations.string()}}};
}

int MapSequence(const Arguments& arguments) {
  ProgressLine progress(kName);
  const semslam::Settings settings = LoadSettingsFor(arguments, progress);
  semslam::TumDataset sequence = OpenSequence(arguments.sequence, arguments.associations, settings);
  RunOptions run;
  run.keep_frame_times = arguments.realtime;
  const auto why_no_frames = [&arguments] {
    return arguments.sequence.string() + ": expected frames, but no frame could be read";
  };
  return MapFrames(arguments, settings, sequence, run, Origin(arguments), why_no_frames, progress);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  const std::unique_ptr<CLI::App> app =
      MakeApp(kName,
              "Maps a recorded RGB-D sequence: trajectory, dense cloud, segments and labelled "
              "objects.");
  AddArguments(*app, arguments);
  if (const std::optional<int> exit_code = Parse(*app, argc, argv)) return *exit_code;
  return RunMappingProgram(kName, [&arguments] { return MapSequence(arguments); });
}

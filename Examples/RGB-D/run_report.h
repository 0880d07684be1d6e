// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "semslam/config/settings.h"
#include "semslam/io/report.h"
#include "semslam/pipeline/system.h"

#include "arguments.h"
#include "keyframe_gallery.h"
#include "map_view.h"
#include "run_loop.h"

// Where the frames of a run came from, for its report.
struct RunOrigin {
  std::string program;                         // With its version.
  std::string name;                            // Such as the folder of the sequence.
  std::filesystem::path truth;                 // A trajectory; may be missing or empty.
  std::vector<semslam::ReportFact> arguments;  // Of the command line, besides the shared ones.
};

// What a run did, as report.html shows it. All that was measured with a clock is in its `speed`.
// Empties the gallery; the clouds stay in the view.
semslam::ReportData MakeReport(const RunOrigin& origin,
                               const MappingArguments& arguments,
                               const semslam::Settings& settings,
                               const RunStatistics& run,
                               const semslam::System& system,
                               const semslam::PointCloudMapping::Result& map,
                               const MapView& view,
                               const KeyframeGallery& gallery);

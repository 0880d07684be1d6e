// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "semslam/camera/frame_source.h"
#include "semslam/pipeline/system.h"

#include "progress_line.h"

// What happened to the frames of a run.
struct RunStatistics {
  std::size_t num_frames = 0;  // Read, tracked or not.
  std::size_t num_tracked = 0;
  std::size_t num_unreadable = 0;  // Skipped.
  // With kept frame times: how many started more than one frame after they were due.
  std::optional<std::size_t> num_late;
  std::vector<double> tracking_milliseconds;  // One a frame read.
  double seconds = 0;
  bool interrupted = false;

  std::size_t num_lost() const { return num_frames - num_tracked; }
};

struct RunOptions {
  bool keep_frame_times = false;      // Wait until a frame is due.
  double fps = 30;                    // Of the recording.
  std::function<bool()> should_stop;  // Asked before every frame.
};

// Feeds all frames of the source to the system. An unreadable frame is reported, counted and
// skipped.
RunStatistics Run(semslam::FrameSource& source,
                  semslam::System& system,
                  const RunOptions& options,
                  ProgressLine& progress);

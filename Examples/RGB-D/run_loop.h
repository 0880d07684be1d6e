// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "semslam/camera/frame_source.h"
#include "semslam/pipeline/system.h"

#include "progress_line.h"

// How well it kept up with a camera.
struct LiveStatistics {
  std::vector<double> latency_milliseconds;  // From a frame's coming to its pose, one each.
  std::size_t num_dropped = 0;               // Came while another was tracked.
};

// How much waited for each thread, after so many frames.
struct QueueSample {
  std::size_t num_frames = 0;
  std::size_t mapping = 0;
  std::size_t loop = 0;
  std::size_t dense = 0;
  std::size_t detector = 0;
};

// What happened to the frames of a run.
struct RunStatistics {
  std::size_t num_frames = 0;  // Read, tracked or not.
  std::size_t num_tracked = 0;
  std::size_t num_left_out = 0;    // Tracked where nothing ties them to the map; see LeaveOut.
  std::size_t num_unreadable = 0;  // Skipped.
  // With kept frame times: how many started more than one frame after they were due.
  std::optional<std::size_t> num_late;
  std::vector<double> tracking_milliseconds;  // One a frame read.
  std::vector<QueueSample> queues;            // Every few frames.
  std::optional<LiveStatistics> live;
  double seconds = 0;
  bool interrupted = false;

  std::size_t num_lost() const { return num_frames - num_tracked - num_left_out; }
  // Of the frames that were tracked, only so many have a pose in the map.
  void LeaveOut(std::size_t num_in_map) {
    num_left_out = num_tracked - std::min(num_tracked, num_in_map);
    num_tracked -= num_left_out;
  }
};

// What a camera knows of itself, for the frame that it gave last.
struct LiveFeed {
  std::function<double()> seconds_since_arrival;
  std::function<std::size_t()> num_dropped;  // So far.
};

struct RunOptions {
  bool keep_frame_times = false;                               // Wait until a frame is due.
  double fps = 30;                                             // Of the recording.
  std::function<bool()> should_stop;                           // Asked before every frame.
  std::optional<LiveFeed> live;                                // If the source is a camera.
  std::function<void(const semslam::RgbdImage&)> on_frame;     // Gets every frame; may be empty.
  std::function<void(const semslam::RgbdImage&)> on_keyframe;  // The same for keyframes.
  std::function<void()> before_frame;  // Between two frames; may wait, may be empty.
  // After each frame, with what tracking made of it; may be empty.
  std::function<void(const semslam::RgbdImagePtr&, const semslam::Tracking::Result&)> on_tracked;
};

// Feeds all frames of the source to the system. An unreadable frame is counted and skipped, and
// the first ones are reported.
RunStatistics Run(semslam::FrameSource& source,
                  semslam::System& system,
                  const RunOptions& options,
                  ProgressLine& progress);

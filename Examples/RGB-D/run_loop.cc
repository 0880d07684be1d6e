// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "run_loop.h"

#include <chrono>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <thread>

#include <unistd.h>

#include "semslam/base/error.h"
#include "semslam/base/stopwatch.h"

namespace {

const char* StateName(semslam::TrackingState state) {
  switch (state) {
    case semslam::TrackingState::kNotInitialized:
      return "waiting";
    case semslam::TrackingState::kTracking:
      return "tracking";
    case semslam::TrackingState::kLost:
      return "lost";
  }
  return "";
}

// One line that is written over while it runs; on a file or pipe, a line every few seconds.
class ProgressLine {
 public:
  explicit ProgressLine(std::optional<std::size_t> num_frames)
      : num_frames_(num_frames), is_terminal_(isatty(STDERR_FILENO) != 0) {}
  ~ProgressLine() { Clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void Show(std::size_t frame, semslam::TrackingState state, const semslam::System& system) {
    const double interval = is_terminal_ ? 0.2 : 5.0;
    if (since_shown_.Seconds() < interval) return;
    since_shown_.Restart();
    const semslam::System::Status status = system.status();
    std::fprintf(stderr,
                 "%sframe %zu/%s  %.1f frames/s  %-8s  %zu keyframes  %zu landmarks  %zu voxels  "
                 "waiting: mapping %zu, dense %zu, detector %zu%s",
                 is_terminal_ ? "\r\033[K" : "", frame,
                 num_frames_ ? std::to_string(*num_frames_).c_str() : "?",
                 static_cast<double>(frame) / total_.Seconds(), StateName(state),
                 status.num_keyframes, status.num_landmarks, status.num_voxels,
                 status.mapping_queue, status.dense_queue, status.detector_queue,
                 is_terminal_ ? "" : "\n");
    is_shown_ = is_terminal_;
  }

  void Clear() {
    if (is_shown_) std::fputs("\r\033[K", stderr);
    is_shown_ = false;
  }

 private:
  std::optional<std::size_t> num_frames_;
  bool is_terminal_;
  bool is_shown_ = false;
  semslam::Stopwatch total_;
  semslam::Stopwatch since_shown_;
};

// Holds frames back until they are due, as a camera would.
class Pacer {
 public:
  // Returns how late the frame is, seconds.
  double WaitFor(semslam::TimeNs time) {
    using Clock = std::chrono::steady_clock;
    if (!first_time_) {
      first_time_ = time;
      start_ = Clock::now();
    }
    const auto due = start_ + std::chrono::nanoseconds(time - *first_time_);
    const double late = std::chrono::duration<double>(Clock::now() - due).count();
    std::this_thread::sleep_until(due);
    return late;
  }

 private:
  std::optional<semslam::TimeNs> first_time_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace

RunStatistics Run(semslam::FrameSource& source,
                  semslam::System& system,
                  const RunOptions& options) {
  RunStatistics statistics;
  ProgressLine progress(source.NumFrames());
  Pacer pacer;
  const semslam::Stopwatch total;
  while (true) {
    if (options.should_stop()) {
      statistics.interrupted = true;
      break;
    }
    std::optional<semslam::RgbdImage> image;
    try {
      image = source.Next();
    } catch (const semslam::InputError& error) {
      progress.Clear();
      std::cerr << "rgbd_tum: frame skipped: " << error.what() << '\n';
      ++statistics.num_unreadable;
      continue;
    }
    if (!image) break;
    if (options.keep_frame_times && pacer.WaitFor(image->time) > 1.0 / options.fps)
      ++statistics.num_late;
    const semslam::Stopwatch tracking;
    const semslam::Tracking::Result result =
        system.TrackRGBD(std::make_shared<const semslam::RgbdImage>(*std::move(image)));
    statistics.tracking_milliseconds.push_back(tracking.Milliseconds());
    ++statistics.num_frames;
    if (result.state == semslam::TrackingState::kTracking) ++statistics.num_tracked;
    progress.Show(statistics.num_frames + statistics.num_unreadable, result.state, system);
  }
  statistics.seconds = total.Seconds();
  return statistics;
}

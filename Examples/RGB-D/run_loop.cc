// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "run_loop.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "semslam/base/error.h"
#include "semslam/base/stopwatch.h"

namespace {

constexpr std::size_t kMaxReports = 10;  // Of unreadable frames.

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

std::string ProgressText(std::size_t frame,
                         std::optional<std::size_t> num_frames,
                         double frames_per_second,
                         semslam::TrackingState state,
                         const semslam::System::Status& status) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(),
                "frame %zu/%s  %.1f/s  %-8s  %zu keyframes  %zu landmarks  "
                "queues: map %zu, cloud %zu, detector %zu",
                frame, num_frames ? std::to_string(*num_frames).c_str() : "?", frames_per_second,
                StateName(state), status.num_keyframes, status.num_landmarks, status.mapping_queue,
                status.dense_queue, status.detector_queue);
  return text.data();
}

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
                  const RunOptions& options,
                  ProgressLine& progress) {
  RunStatistics statistics;
  if (options.keep_frame_times) statistics.num_late = 0;
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
      if (statistics.num_unreadable < kMaxReports)
        progress.Report(std::string("frame skipped: ") + error.what());
      if (++statistics.num_unreadable == kMaxReports)
        progress.Report("further unreadable frames are counted only");
      continue;
    }
    if (!image) break;
    if (options.keep_frame_times && pacer.WaitFor(image->time) > 1.0 / options.fps)
      ++*statistics.num_late;
    const semslam::Stopwatch tracking;
    const semslam::Tracking::Result result =
        system.TrackRGBD(std::make_shared<const semslam::RgbdImage>(*std::move(image)));
    statistics.tracking_milliseconds.push_back(tracking.Milliseconds());
    ++statistics.num_frames;
    if (result.map_was_reset) statistics.num_tracked = 0;  // Their poses went with the map.
    if (result.state == semslam::TrackingState::kTracking) ++statistics.num_tracked;
    if (!progress.is_due()) continue;
    const std::size_t frame = statistics.num_frames + statistics.num_unreadable;
    progress.Update(ProgressText(frame, source.NumFrames(),
                                 static_cast<double>(frame) / total.Seconds(), result.state,
                                 system.status()));
  }
  statistics.seconds = total.Seconds();
  return statistics;
}

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "run_loop.h"

#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "semslam/base/error.h"
#include "semslam/base/stopwatch.h"

#include "format_line.h"
#include "quantile.h"
#include "tracking_words.h"

namespace {

constexpr std::size_t kMaxReports = 10;      // Of unreadable frames.
constexpr std::size_t kFramesPerSample = 5;  // Of the queues.

// How fast and how late the last frames were.
class RecentFrames {
 public:
  void Add(double latency_milliseconds) {
    frames_.push_back({watch_.Seconds(), latency_milliseconds});
    if (frames_.size() > kMaxFrames) frames_.pop_front();
  }

  // Not to be asked before the first frame.
  std::string Text(std::size_t num_dropped) const {
    const double seconds = frames_.back().time - frames_.front().time;
    const double rate = seconds > 0 ? static_cast<double>(frames_.size() - 1) / seconds : 0;
    std::vector<double> latencies;
    for (const Frame& frame : frames_) latencies.push_back(frame.latency_milliseconds);
    return Line("%.1f/s  %zu dropped  %.0f/%.0f ms late", rate, num_dropped,
                Quantile(latencies, 0.5), Quantile(latencies, 0.95));
  }

 private:
  static constexpr std::size_t kMaxFrames = 90;
  struct Frame {
    double time = 0;  // Seconds.
    double latency_milliseconds = 0;
  };
  semslam::Stopwatch watch_;
  std::deque<Frame> frames_;
};

std::string ProgressText(const std::string& frame,
                         const std::string& speed,
                         semslam::TrackingState state,
                         const semslam::System::Status& status) {
  return Line(
      "frame %s  %s  %-8s  %zu keyframes  %zu landmarks  "
      "queues: map %zu, cloud %zu, detector %zu",
      frame.c_str(), speed.c_str(), StateName(state), status.num_keyframes, status.num_landmarks,
      status.mapping_queue, status.dense_queue, status.detector_queue);
}

// Frames read so far, of how many.
std::string FrameText(std::size_t frame, const semslam::FrameSource& source, bool is_live) {
  if (is_live) return std::to_string(frame);
  const std::optional<std::size_t> num_frames = source.NumFrames();
  return std::to_string(frame) + "/" + (num_frames ? std::to_string(*num_frames) : "?");
}

// Holds frames back until they are due, as a camera would.
class Pacer {
 public:
  // Returns how late the frame is, seconds.
  double WaitFor(semslam::TimeNs time) {
    if (!first_time_) {
      first_time_ = time;
      start_ = Clock::now();
    }
    const auto due = start_ + std::chrono::nanoseconds(time - *first_time_);
    const double late = std::chrono::duration<double>(Clock::now() - due).count();
    std::this_thread::sleep_until(due);
    return late;
  }

  // Nobody waited for frames in that time: the ones to come are due as much later.
  void Shift(double seconds) {
    start_ += std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::optional<semslam::TimeNs> first_time_;
  Clock::time_point start_;
};

// Reads, tracks and counts. One for a run.
class Runner {
 public:
  Runner(semslam::FrameSource& source,
         semslam::System& system,
         const RunOptions& options,
         ProgressLine& progress)
      : source_(source), system_(system), options_(options), progress_(progress) {
    if (options.keep_frame_times) statistics_.num_late = 0;
    if (options.live) statistics_.live.emplace();
  }

  RunStatistics Run() {
    while (true) {
      BetweenFrames();
      if (options_.should_stop()) break;
      std::optional<semslam::RgbdImage> image;
      try {
        image = source_.Next();
      } catch (const semslam::InputError& error) {
        CountUnreadable(error.what());
        continue;
      }
      if (!image) break;
      const semslam::TrackingState state = Track(*std::move(image));
      if (progress_.is_due()) ShowProgress(state);
    }
    // A camera stops by itself when it is to.
    statistics_.interrupted = options_.should_stop();
    if (options_.live) statistics_.live->num_dropped = options_.live->num_dropped();
    statistics_.seconds = total_.Seconds();
    return std::move(statistics_);
  }

 private:
  void BetweenFrames() {
    if (!options_.before_frame) return;
    const semslam::Stopwatch pause;
    options_.before_frame();
    pacer_.Shift(pause.Seconds());
  }

  void CountUnreadable(const std::string& error) {
    if (statistics_.num_unreadable < kMaxReports) progress_.Report("frame skipped: " + error);
    if (++statistics_.num_unreadable == kMaxReports)
      progress_.Report("further unreadable frames are counted only");
  }

  semslam::TrackingState Track(semslam::RgbdImage image) {
    if (options_.keep_frame_times && pacer_.WaitFor(image.time) > 1.0 / options_.fps)
      ++*statistics_.num_late;
    if (options_.on_frame) options_.on_frame(image);
    const auto shared_image = std::make_shared<const semslam::RgbdImage>(std::move(image));
    const semslam::Stopwatch tracking;
    const semslam::Tracking::Result result = system_.TrackRGBD(shared_image);
    statistics_.tracking_milliseconds.push_back(tracking.Milliseconds());
    if (options_.live) {
      const double latency = 1e3 * options_.live->seconds_since_arrival();
      statistics_.live->latency_milliseconds.push_back(latency);
      recent_.Add(latency);
    }
    ++statistics_.num_frames;
    if (options_.on_tracked) options_.on_tracked(shared_image, result);
    if (options_.on_keyframe && result.new_keyframe) options_.on_keyframe(*shared_image);
    if (statistics_.num_frames % kFramesPerSample == 0) SampleQueues();
    if (result.map_was_reset) statistics_.num_tracked = 0;  // Their poses went with the map.
    if (result.state == semslam::TrackingState::kTracking) ++statistics_.num_tracked;
    return result.state;
  }

  void SampleQueues() {
    const semslam::System::Status status = system_.status();
    statistics_.queues.push_back({statistics_.num_frames, status.mapping_queue, status.loop_queue,
                                  status.dense_queue, status.detector_queue});
  }

  void ShowProgress(semslam::TrackingState state) {
    const std::size_t frame = statistics_.num_frames + statistics_.num_unreadable;
    const std::string speed = options_.live
                                  ? recent_.Text(options_.live->num_dropped())
                                  : Line("%.1f/s", static_cast<double>(frame) / total_.Seconds());
    progress_.Update(ProgressText(FrameText(frame, source_, options_.live.has_value()), speed,
                                  state, system_.status()));
  }

  semslam::FrameSource& source_;
  semslam::System& system_;
  const RunOptions& options_;
  ProgressLine& progress_;
  RunStatistics statistics_;
  RecentFrames recent_;
  Pacer pacer_;
  const semslam::Stopwatch total_;
};

}  // namespace

RunStatistics Run(semslam::FrameSource& source,
                  semslam::System& system,
                  const RunOptions& options,
                  ProgressLine& progress) {
  return Runner(source, system, options, progress).Run();
}

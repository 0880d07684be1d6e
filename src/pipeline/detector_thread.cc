// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/pipeline/detector_thread.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "semslam/base/check.h"
#include "semslam/base/stopwatch.h"

namespace semslam {

DetectorThread::DetectorThread(Threading threading, std::unique_ptr<Detector> detector, Sink sink)
    : detector_(std::move(detector)),
      sink_(std::move(sink)),
      // Never full in practice: a keyframe's colour image is 0.9 MB, so memory would run out first.
      stage_({.threading = threading,
              .queue_capacity = 4096,
              .order = QueueOrder::kNewestFirst,
              .is_background = true},
             [this](const Job& job) { Process(job); }) {
  SEMSLAM_CHECK(detector_ != nullptr);
}

bool DetectorThread::Submit(KeyframeId keyframe, const RgbdImagePtr& image) {
  Job job{keyframe, {image->time, image->color, cv::Mat()}};
  statistics_.Write([](Statistics& s) { ++s.num_submitted; });
  const bool is_taken = stage_.TrySubmit(std::move(job));
  statistics_.Write(
      [&](Statistics& s) { s.longest_queue = std::max(s.longest_queue, stage_.queue_size()); });
  return is_taken;
}

void DetectorThread::Process(const Job& job) {
  std::vector<Detection> detections;
  try {
    const Stopwatch stopwatch;
    detections = detector_->Detect(job.image);
    const double milliseconds = stopwatch.Milliseconds();
    statistics_.Write([&](Statistics& s) {
      ++s.num_done;
      s.mean_milliseconds += (milliseconds - s.mean_milliseconds) / static_cast<double>(s.num_done);
    });
  } catch (const std::exception& error) {
    // One image without labels is no reason to lose the map; the count and the text go into the
    // summary.
    statistics_.Write([&](Statistics& s) {
      if (s.num_failed++ == 0) s.first_error = error.what();
    });
    return;
  }
  sink_(job.keyframe, std::move(detections));
}

void DetectorThread::Finish() { stage_.Finish(); }

void DetectorThread::Cancel() { stage_.Cancel(); }

DetectorThread::Statistics DetectorThread::statistics() const {
  return statistics_.Read([](const Statistics& s) { return s; });
}

}  // namespace semslam

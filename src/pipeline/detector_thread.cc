// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/pipeline/detector_thread.h"

#include <algorithm>
#include <exception>
#include <optional>
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
             [this](Job job) { Process(std::move(job)); }) {
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

void DetectorThread::Process(Job first) {
  std::vector<KeyframeId> keyframes = {first.keyframe};
  std::vector<RgbdImage> images = {std::move(first.image)};
  while (images.size() < detector_->batch_size()) {
    std::optional<Job> next = stage_.TryTakeNext();
    if (!next) break;
    keyframes.push_back(next->keyframe);
    images.push_back(std::move(next->image));
  }
  if (images.size() > 1 && LookAt(keyframes, images)) return;
  // One by one too if they failed together: one bad image costs the labels of no other.
  for (std::size_t i = 0; i < images.size(); ++i) {
    const std::span<const RgbdImage> alone(&images[i], 1);
    LookAt({&keyframes[i], 1}, alone);
  }
}

bool DetectorThread::LookAt(std::span<const KeyframeId> keyframes,
                            std::span<const RgbdImage> images) {
  std::vector<std::vector<Detection>> found;
  try {
    const Stopwatch stopwatch;
    if (images.size() == 1) {
      found.push_back(detector_->Detect(images.front()));
    } else {
      found = detector_->DetectAll(images);
    }
    const double milliseconds = stopwatch.Milliseconds();
    statistics_.Write([&](Statistics& s) {
      const auto count = static_cast<double>(images.size());
      s.num_done += images.size();
      s.mean_milliseconds +=
          (milliseconds - count * s.mean_milliseconds) / static_cast<double>(s.num_done);
    });
  } catch (const std::exception& error) {
    // One image without labels is no reason to lose the map; the count and the text go into the
    // summary.
    if (images.size() > 1) return false;
    statistics_.Write([&](Statistics& s) {
      if (s.num_failed++ == 0) s.first_error = error.what();
    });
    return false;
  }
  for (std::size_t i = 0; i < keyframes.size(); ++i) sink_(keyframes[i], std::move(found[i]));
  return true;
}

void DetectorThread::Finish() { stage_.Finish(); }

void DetectorThread::Cancel() { stage_.Cancel(); }

DetectorThread::Statistics DetectorThread::statistics() const {
  return statistics_.Read([](const Statistics& s) { return s; });
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "semslam/base/guarded.h"
#include "semslam/base/id.h"
#include "semslam/base/stage.h"
#include "semslam/camera/rgbd_image.h"
#include "semslam/semantics/detector.h"

namespace semslam {

// Runs the object detector on keyframes, in a thread of its own and the newest first, so that the
// map is labelled where the camera is. Nothing waits for it; at the end it works off what is left.
class DetectorThread {
 public:
  // Called from the detector's thread (kInline: the caller's) for every keyframe that was looked
  // at.
  using Sink = std::function<void(KeyframeId, std::vector<Detection>)>;

  struct Statistics {
    std::size_t num_submitted = 0;
    std::size_t num_done = 0;
    // Images on which the detector threw; the run goes on without their labels.
    std::size_t num_failed = 0;
    std::string first_error;        // What it said the first time.
    double mean_milliseconds = 0;   // Per image that was done.
    std::size_t longest_queue = 0;  // Images that waited at once.
  };

  DetectorThread(Threading threading, std::unique_ptr<Detector> detector, Sink sink);

  // Keeps the colour image until the detector has time for it. False once finished.
  bool Submit(KeyframeId keyframe, const RgbdImagePtr& image);
  // Looks at all that is left, then ends the thread. Rethrows what the sink threw.
  void Finish();
  // Ends after the image in hand; the rest stays without labels.
  void Cancel();

  std::size_t queue_size() const { return stage_.queue_size(); }
  Statistics statistics() const;

 private:
  struct Job {
    KeyframeId keyframe;
    RgbdImage image;  // Without depth.
  };
  // Takes waiting images along, as many as the detector likes at once.
  void Process(Job first);
  // False: failed.
  bool LookAt(std::span<const KeyframeId> keyframes, std::span<const RgbdImage> images);

  std::unique_ptr<Detector> detector_;
  Sink sink_;
  Guarded<Statistics> statistics_;
  Stage<Job> stage_;  // Last: its thread ends before what it uses.
};

}  // namespace semslam

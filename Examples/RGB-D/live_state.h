// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "semslam/base/guarded.h"
#include "semslam/base/stopwatch.h"
#include "semslam/camera/rgbd_image.h"
#include "semslam/pipeline/step.h"
#include "semslam/pipeline/system.h"
#include "semslam/semantics/detector.h"

// What the threads of a run tell a viewer, and what its buttons ask of the run. Each side writes
// down little and waits for nothing. For any number of threads.
class LiveState {
 public:
  // The newest frame, as tracking left it. Immutable.
  struct Tracked {
    std::size_t number = 0;
    semslam::RgbdImagePtr image;
    semslam::Tracking::Result result;
  };
  struct Detected {
    cv::Mat color;
    std::vector<semslam::Detection> detections;
  };
  static constexpr std::size_t kNumSteps = 10;                 // Of semslam::Step.
  using StepTimes = std::array<std::deque<float>, kNumSteps>;  // Milliseconds, newest last.

  // --- The run's side
  void Show(const semslam::RgbdImagePtr& image, const semslam::Tracking::Result& result);
  void CountStep(semslam::Step step, double seconds);
  void ShowDetections(const cv::Mat& color, const std::vector<semslam::Detection>& detections);
  // Between two frames: does to the system what the buttons asked for, and waits while paused and
  // not to stop.
  void ObeyBetweenFrames(semslam::System& system, const std::function<bool()>& should_stop);
  void SetEnded();
  void SetMessage(const std::string& message);

  // --- The viewer's side
  std::shared_ptr<const Tracked> tracked() const;    // Null before the first.
  std::shared_ptr<const Detected> detected() const;  // The same.
  StepTimes step_times() const;
  double frames_per_second() const;
  bool has_ended() const;
  std::string message() const;
  bool is_paused() const;
  bool is_localization_only() const;
  void SetPaused(bool paused);
  void Step();
  void RequestReset();
  void RequestLocalizationOnly(bool localization_only);
  // Before the first frame: how the run begins.
  void StartWithLocalizationOnly(bool localization_only);

 private:
  struct Commands {
    bool is_paused = false;
    bool may_step = false;  // One frame although paused.
    bool reset = false;
    bool is_localization_only = false;
    bool localization_has_changed = false;
  };
  struct Rate {
    semslam::Stopwatch watch;
    std::deque<double> times;  // Of the last frames, seconds.
  };
  struct Ending {
    bool has_ended = false;
    std::string message;
  };

  semslam::Guarded<std::shared_ptr<const Tracked>> tracked_;
  semslam::Guarded<std::shared_ptr<const Detected>> detected_;
  semslam::Guarded<StepTimes> step_times_;
  semslam::Guarded<Rate> rate_;
  semslam::Guarded<Commands> commands_;
  semslam::Guarded<Ending> ending_;
};

// A detector that also shows the viewer what it finds. Null for none.
std::unique_ptr<semslam::Detector> ShowIn(std::shared_ptr<LiveState> state,
                                          std::unique_ptr<semslam::Detector> detector);

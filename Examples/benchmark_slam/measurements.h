// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <map>
#include <thread>
#include <vector>

#include "semslam/base/guarded.h"
#include "semslam/pipeline/step.h"

// Collects what a System tells while it runs. Its methods may be called from any thread.
class Measurements {
 public:
  // Made in the thread that tracks: waits of other threads are kept apart.
  Measurements() : tracking_thread_(std::this_thread::get_id()) {}

  void AddStep(semslam::Step step, double seconds);
  void AddWait(double seconds);

  // All in seconds, in the order in which they came.
  std::vector<double> StepTimes(semslam::Step step) const;
  std::vector<double> TrackingWaits() const;
  std::vector<double> OtherWaits() const;

 private:
  struct Lists {
    std::map<semslam::Step, std::vector<double>> steps;
    std::vector<double> tracking_waits;
    std::vector<double> other_waits;
  };

  const std::thread::id tracking_thread_;
  semslam::Guarded<Lists> lists_;
};

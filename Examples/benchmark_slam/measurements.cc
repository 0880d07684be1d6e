// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "measurements.h"

void Measurements::AddStep(semslam::Step step, double seconds) {
  lists_.Write([&](Lists& lists) { lists.steps[step].push_back(seconds); });
}

void Measurements::AddWait(double seconds) {
  const bool is_tracking = std::this_thread::get_id() == tracking_thread_;
  lists_.Write([&](Lists& lists) {
    (is_tracking ? lists.tracking_waits : lists.other_waits).push_back(seconds);
  });
}

std::vector<double> Measurements::StepTimes(semslam::Step step) const {
  return lists_.Read([&](const Lists& lists) {
    const auto found = lists.steps.find(step);
    return found == lists.steps.end() ? std::vector<double>() : found->second;
  });
}

std::vector<double> Measurements::TrackingWaits() const {
  return lists_.Read([](const Lists& lists) { return lists.tracking_waits; });
}

std::vector<double> Measurements::OtherWaits() const {
  return lists_.Read([](const Lists& lists) { return lists.other_waits; });
}

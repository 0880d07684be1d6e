// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "live/stream_watch.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace semslam {
namespace {

std::string Seconds(double seconds) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f s", seconds);
  return text.data();
}

}  // namespace

void StreamWatch::Start(double now) {
  color_ = depth_ = pairs_ = {.last = now, .has_images = false};
}

void StreamWatch::OnImage(StreamKind kind, double now) {
  (kind == StreamKind::kColor ? color_ : depth_) = {.last = now, .has_images = true};
}

void StreamWatch::OnPair(double now) { pairs_ = {.last = now, .has_images = true}; }

bool StreamWatch::IsLate(const Stream& stream, double now) const {
  return now - stream.last > (stream.has_images ? stall_seconds_ : start_seconds_);
}

std::optional<std::string> StreamWatch::Check(double now) const {
  const bool no_color = IsLate(color_, now);
  const bool no_depth = IsLate(depth_, now);
  const double color_age = now - color_.last;
  const double depth_age = now - depth_.last;
  // One that has come just now shows that the camera is there; the other has its time to follow.
  const bool is_silent = std::min(color_age, depth_age) > stall_seconds_ / 2;
  if ((no_color || no_depth) && is_silent)
    return "no images for " + Seconds(std::max(color_age, depth_age));
  if (no_color) return "no colour images for " + Seconds(color_age) + ", depth images still come";
  if (no_depth) return "no depth images for " + Seconds(depth_age) + ", colour images still come";
  // Later than the above, which say it better where one stream has just stopped.
  if (now - pairs_.last > start_seconds_) {
    return "colour and depth images come, but for " + Seconds(now - pairs_.last) +
           " none that belong together by their times";
  }
  return std::nullopt;
}

}  // namespace semslam

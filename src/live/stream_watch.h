// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "live/frame_pairer.h"

namespace semslam {

// Tells when a camera that was opened does not send what it should. Times are seconds of one clock,
// since anything.
class StreamWatch {
 public:
  // What may pass without images once they came, and before the first ones.
  StreamWatch(double stall_seconds, double start_seconds)
      : stall_seconds_(stall_seconds), start_seconds_(start_seconds) {}

  void Start(double now);
  void OnImage(StreamKind kind, double now);
  void OnPair(double now);

  // What is wrong, if something is.
  std::optional<std::string> Check(double now) const;

 private:
  struct Stream {
    double last = 0;  // Image, or start.
    bool has_images = false;
  };

  bool IsLate(const Stream& stream, double now) const;

  double stall_seconds_;
  double start_seconds_;
  Stream color_;
  Stream depth_;
  Stream pairs_;
};

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "semslam/base/stopwatch.h"
#include "semslam/live/openni2_source.h"

#include "live/camera_session.h"
#include "live/device_clock.h"
#include "live/frame_pairer.h"
#include "live/openni_context.h"
#include "live/stream_watch.h"

namespace semslam {

// Reads the camera and sees to faults.
class OpenNi2Source::Reader {
 public:
  explicit Reader(Options options);

  std::optional<RgbdImage> Next();
  double SecondsSinceArrival() const { return age_ + since_read_.Seconds(); }
  Statistics statistics() const;
  const std::optional<std::string>& failure() const { return failure_; }
  const std::string& description() const { return description_; }
  bool is_file() const { return is_file_; }
  std::optional<std::size_t> NumFrames() const { return num_frames_; }
  const std::optional<PinholeCamera::Parameters>& nominal_intrinsics() const {
    return nominal_intrinsics_;
  }

 private:
  void Open(const std::string& device);
  // Waits a little for an image. A pair, if one is complete. Throws InputError at a fault.
  std::optional<RgbdImage> Step();
  RgbdImage Join(ImagePair pair, double age);
  // Tells, once, if the camera does not take colour and depth at the same time.
  void LookAtTimes(const ImagePair& pair);
  void StartRecording();
  // Opens the camera again. False if that did not work in time, or was stopped.
  bool Recover(const std::string& fault);
  bool TryToOpenAgain(std::string* problem);
  bool IsStopped() const;
  void End();
  void Log(LogLevel level, const std::string& message) const;

  const Options options_;
  OpenNiContext context_;                   // Kept, so that a camera's coming back is noticed.
  std::unique_ptr<CameraSession> session_;  // Null once it is over.
  CameraIdentity camera_;
  bool is_file_ = false;
  std::string description_;
  std::optional<std::size_t> num_frames_;
  std::optional<PinholeCamera::Parameters> nominal_intrinsics_;

  FramePairer pairer_;
  std::int64_t times_apart_us_ = 0;  // Sum over the first pairs.
  DeviceClock clock_;
  StreamWatch watch_;
  double waited_ = 0;  // Seconds in all: the clock of watch_. A stall is one that we wait through.
  std::optional<TimeNs> first_time_;
  // Since a fault was reported, if no pair has come after it.
  std::optional<Stopwatch> interruption_;
  bool is_recording_ = false;
  int num_recordings_ = 0;
  std::size_t num_damaged_ = 0;  // Images of a recording.
  double age_ = 0;               // Of the newest pair when it was read, seconds.
  Stopwatch since_read_;
  Statistics statistics_;
  std::optional<std::string> failure_;
};

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "semslam/camera/pinhole_camera.h"

#include "live/frame_pairer.h"

namespace semslam {

// Which camera it was: its place on the bus, and so its URI, changes when it is plugged in again.
struct CameraIdentity {
  std::string uri;
  std::string vendor;
  std::string name;
  int usb_vendor = 0;
  int usb_product = 0;
};

struct CameraRequest {
  int width = 640;   // Pixels.
  int height = 480;  // Pixels.
  int fps = 30;
  bool is_rgb = true;
  bool auto_exposure = true;
  bool accept_unregistered = false;
  bool play_in_real_time = false;  // Recordings.
};

// One camera or recording, opened, with both streams running. For one thread.
class CameraSession {
 public:
  // Told, in one line each, what the camera refused where it goes on all the same.
  using Notice = std::function<void(const std::string&)>;

  struct Arrival {
    StreamKind kind = StreamKind::kColor;
    StreamImage image;
    double age = 0;  // Seconds since it came.
    // Images of the stream before it that were not read in time, or cannot be read.
    std::size_t num_missed = 0;
  };

  // `device`: URI or path; empty: the first camera. Throws InputError that says what to do.
  CameraSession(const std::string& device, const CameraRequest& request, const Notice& notice);
  ~CameraSession();

  // The next image of either stream; nothing if none came in this time. Throws InputError if the
  // camera is gone or sends something else than was asked for.
  std::optional<Arrival> Wait(std::chrono::milliseconds timeout);

  // Writes what comes from now on to a file, without loss. Every stream must have sent an image:
  // OpenNI2 counts each one's time from its first image on. Ends with the session.
  void StartRecording(const std::filesystem::path& path);

  const CameraIdentity& identity() const;
  bool is_file() const;
  // Of a recording: images of the shorter stream; nothing if it has no end that says so.
  std::optional<std::size_t> NumFrames() const;
  // Of a recording: nothing more will come. One without an end just stops sending.
  bool is_at_end() const;
  std::string description() const;
  std::optional<PinholeCamera::Parameters> NominalIntrinsics() const;

 private:
  struct Streams;
  std::unique_ptr<Streams> streams_;
};

// The URI under which a camera is to be found now that was there before, perhaps in another place.
// Nothing if it is not there.
std::optional<std::string> FindAgain(const CameraIdentity& camera);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "semslam/base/log.h"
#include "semslam/base/time.h"
#include "semslam/camera/frame_source.h"
#include "semslam/camera/pinhole_camera.h"
#include "semslam/camera/rgbd_image.h"

namespace semslam {

// A depth camera, or a recording of one in OpenNI2's format (.oni), read through OpenNI2.
//
// A camera does not wait: whoever is slower than it gets the newest frame, and what was left out is
// counted. So a frame is never older than the one that was in hand when it came. A camera that
// stops sending, one of whose streams stops, that sends something else than was asked for, or that
// is pulled out, is closed and opened again until it is back or the patience ends.
//
// A recording waits, unless it is to be played in real time: every frame comes, as fast as asked.
//
// For one thread, which should live as long as the process: OpenNI2 remembers every thread that
// ever called it, and looks for them when another one does (2.2.0.33 crashes then if it is gone).
class OpenNi2Source : public FrameSource {
 public:
  struct Options {
    // URI of a camera, path of a recording, or empty: the first camera that is there.
    std::string device;
    int width = 640;            // Of both images, pixels.
    int height = 480;           // Pixels.
    int fps = 30;               // Of both streams, frames per second.
    bool is_rgb = true;         // Colour comes as red, green, blue; some cameras mean the reverse.
    bool auto_exposure = true;  // Exposure and white balance adjust themselves.
    bool accept_unregistered = false;   // Go on with a camera that cannot register its images.
    bool play_in_real_time = false;     // Recordings only.
    std::filesystem::path recording;    // To be written, .oni; empty: none.
    std::optional<TimeNs> duration;     // Ends that long after the first frame.
    double stall_seconds = 1;           // Without frames: something is wrong.
    double start_seconds = 3;           // The same, for the first frames after opening.
    double patience_seconds = 30;       // How long a camera may be away.
    LogSink log;                        // May be empty. Told of faults and what follows.
    std::function<bool()> should_stop;  // Asked several times a second; may be empty.
    void Validate() const;              // Throws std::invalid_argument.
  };

  struct Statistics {
    std::size_t num_pairs = 0;          // Colour and depth that belong together.
    std::size_t num_dropped = 0;        // Colour images that came while Next was not called.
    std::size_t num_unpaired = 0;       // Images of one kind without one of the other.
    std::size_t num_interruptions = 0;  // Faults after which frames came again.
  };

  // Opens the camera or recording and starts it. Throws InputError, saying what to do, if that
  // cannot be had.
  explicit OpenNi2Source(Options options);
  ~OpenNi2Source() override;

  // Waits for the next frame. Times are those of the camera's clock, set to the system's time by
  // the first frame; those of a recording begin near 0. Nothing at the end: of the recording, of
  // the duration, if asked to stop, or after a failure.
  std::optional<RgbdImage> Next() override;
  std::optional<std::size_t> NumFrames() const override;

  // Why it ended, if not as intended: the camera did not come back, the recording is damaged.
  std::optional<std::string> failure() const;
  // Since both images of the frame that Next gave last had come, read or not.
  double SecondsSinceArrival() const;
  Statistics statistics() const;

  // What is opened, for people.
  std::string description() const;
  bool is_recording() const;  // Not a camera.
  // As the maker's field of view says, without distortion. Nothing if there is none given.
  std::optional<PinholeCamera::Parameters> NominalIntrinsics() const;

 private:
  class Reader;
  std::unique_ptr<Reader> reader_;
};

}  // namespace semslam

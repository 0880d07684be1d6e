// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <optional>

#include "semslam/camera/pinhole_camera.h"
#include "semslam/features/frame.h"
#include "semslam/features/scale_space.h"
#include "semslam/geometry/rigid3.h"
#include "semslam/tracking/tracked_frame.h"

namespace semslam {

// Frees frames from the skew of a rolling shutter, and learns how strong it is.
//
// Most colour cameras expose one row after the other; from the first to the last it takes the
// readout time (26 ms for the Kinect's colour camera: Ringaby and Forssen, "Scan rectification for
// structured light range sensors with rolling shutters", ICCV 2011). At hand-held speed a corner is
// then several pixels from where one instant's image would have it. A frame's time and pose are
// those of its middle row here.
//
// The readout time is a setting, or estimated while tracking: what a row is off by, in proportion
// to the camera's velocity, cannot be explained by a pose. One thread at a time.
class RollingShutter {
 public:
  static constexpr double kMaxReadoutSeconds = 0.05;  // No camera of 30 Hz takes longer.

  struct Options {
    // First to last row, seconds; < 0: rows come from below; 0: all at once. Nothing: estimated.
    std::optional<double> readout_seconds;
    void Validate() const;  // Throws std::logic_error.
  };

  RollingShutter(const Options& options, const PinholeCamera& camera, double baseline_times_fx);

  // What frames are corrected for: as given, or as estimated, 0 until it is certain that it is not.
  double readout_seconds() const { return readout_seconds_; }

  // The recorded frame as if all rows had been exposed at the middle row's time. `velocity` is the
  // camera's, (rotation, translation) a second in its own frame, as Retract takes it. Points
  // without depth are taken as far as the others are on average.
  std::shared_ptr<const Frame> Correct(std::shared_ptr<const Frame> recorded,
                                       const Vector6d& velocity) const;

  // Learns from a frame that was corrected and found in the map with this velocity; nothing where
  // the readout time is given.
  void Learn(const Frame& recorded,
             const TrackedFrame& found,
             const Vector6d& velocity,
             const ScaleSpace& scale_space);

 private:
  void Update(double measured, double information);

  PinholeCamera camera_;
  double baseline_times_fx_;
  bool is_estimated_;
  double readout_seconds_;
  double estimate_ = 0;  // Seconds.
  double variance_;      // Of the estimate, s^2.
};

}  // namespace semslam

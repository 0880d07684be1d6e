// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "semslam/camera/pinhole_camera.h"
#include "semslam/camera/rgbd_image.h"
#include "semslam/features/frame.h"
#include "semslam/features/orb_extractor.h"

namespace semslam {

// Turns an RGB-D image into a frame: features, freed from lens distortion, with depth and a place
// in the grid. Immutable: threads may share one.
class FrameBuilder {
 public:
  // `baseline_times_fx` (px m, > 0) is the baseline of the virtual stereo camera times fx.
  FrameBuilder(OrbExtractor::Options options,
               const PinholeCamera& camera,
               double baseline_times_fx);

  // The images must have the camera's size and the types of RgbdImage; else std::logic_error.
  Frame Build(const RgbdImage& image) const;

  const OrbExtractor& extractor() const { return extractor_; }
  const PinholeCamera& camera() const { return camera_; }

 private:
  OrbExtractor extractor_;
  PinholeCamera camera_;
  double baseline_times_fx_;
};

}  // namespace semslam

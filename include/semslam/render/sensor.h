// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <opencv2/core/mat.hpp>

#include "semslam/camera/pinhole_camera.h"
#include "semslam/geometry/rigid3.h"
#include "semslam/render/renderer.h"

namespace semslam {

// How a colour camera turns light into a picture.
struct ColorSensorOptions {
  double exposure_s = 0.012;  // The picture is smeared by the motion in this time; 0: sharp.
  double gain = 1.0;          // Pixel value is 255 sqrt(gain * radiance).
  double gain_drift = 0.06;   // Largest relative change of the gain, over some seconds.
  double vignetting = 0.18;   // Loss of light in the corners.
  double read_noise = 1.3;    // Standard deviation in grey levels, in the dark.
  double shot_noise = 1.6;    // The same for white, added in quadrature.
  static ColorSensorOptions Clean();
  void Validate() const;  // Throws std::invalid_argument.
};

// A structured-light sensor. Its disparity is focal * baseline / z; quantised and noisy disparity
// gives a depth error that grows with z^2 (Khoshelham and Oude Elberink, "Accuracy and Resolution
// of Kinect Depth Data", 2012: 1.4 mm and steps of 2.9 mm at 1 m, both times z^2). Edges are frayed
// as in Handa et al., "A Benchmark for RGB-D Visual Odometry, 3D Reconstruction and SLAM", 2014.
struct DepthSensorOptions {
  double focal_px = 580;             // Of the infrared camera.
  double baseline_m = 0.075;         // The projector is this far to the camera's right.
  double disparity_step_px = 0.125;  // 0: not quantised.
  double disparity_noise_px = 0.05;  // Standard deviation, added before quantising.
  double fray_px = 0.5;              // Standard deviation of where a pixel really looks.
  double min_depth_m = 0.5;          // Nearer and farther is missing.
  double max_depth_m = 4.5;
  double min_incidence = 0.17;   // Cosine below which (80 degrees) nothing comes back.
  bool projector_shadow = true;  // What the projector cannot light is missing.
  double hole_rate = 0.3;        // Part of the pixels beside a jump of depth that are missing.
  static DepthSensorOptions Clean();
  void Validate() const;  // Throws std::invalid_argument.
};

// The time a frame is taken, and how the camera moves then.
struct FrameMotion {
  std::uint64_t seed = 0;   // Of this clip.
  std::uint64_t frame = 0;  // Number; with the seed it determines all noise.
  double time_s = 0;        // Since the start.
  Rigid3 T_world_camera = {};
  Rigid3 T_world_camera_open = {};   // At the start of the exposure, which is centred on time_s.
  Rigid3 T_world_camera_close = {};  // At its end.
};

// CV_8UC3, BGR. `rays`: the camera's. The same bytes on any number of threads.
cv::Mat SenseColor(const IdealImage& ideal,
                   const PinholeCamera& camera,
                   const RayTable& rays,
                   const FrameMotion& motion,
                   const ColorSensorOptions& options,
                   int num_threads);

// CV_16UC1 in units of 1 / depth_factor metres, 0 where there is none: as the PNG files have it.
cv::Mat SenseDepth(const IdealImage& ideal,
                   const FrameMotion& motion,
                   const DepthSensorOptions& options,
                   double depth_factor,
                   int num_threads);

}  // namespace semslam

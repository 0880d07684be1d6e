// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "semslam/camera/pinhole_camera.h"

namespace semslam {

// Which depth pixels of a structured-light or time-of-flight camera can be trusted.
struct DepthFilterOptions {
  double min_depth = 0.3;  // Metres.
  double max_depth = 4.0;  // Metres; beyond, the noise exceeds a few centimetres.
  // Step of the depth values at 1 m, growing with z^2: 1 / (f b 8) for the Kinect's eighth of a
  // pixel of disparity. Also the scale of the noise.
  double depth_step_at_1m = 0.0029;  // Metres.
  // A surface seen at a larger angle than this against its normal is no longer told from an edge.
  double max_grazing_angle = 1.4;  // Radians (80 degrees).
  int edge_margin = 2;             // Pixels on both sides of a depth edge that are rejected.
  // Normals: plane fit over (2 radius + 1)^2 samples, `spacing` pixels apart.
  int normal_radius = 3;                 // Samples.
  int normal_spacing = 2;                // Pixels.
  double min_normal_sample_share = 0.3;  // Of the window's samples that lie on the same surface.

  void Validate() const;  // Throws InputError.
};

// The depth (CV_32FC1, metres) with every pixel set to 0 that is out of range, or next to a depth
// jump larger than a surface at max_grazing_angle explains: those are mixed ("flying") pixels.
cv::Mat FilterDepth(const cv::Mat& depth, const RayTable& rays, const DepthFilterOptions& options);

// Unit normals, towards the camera, of the pixels (i stride, j stride), row by row; zero where the
// depth is 0, too few neighbours lie on the same surface, or the surface is seen at a grazing
// angle. A plane has an inverse depth that is linear in the ray (x/z, y/z), and the sensor's noise
// is uniform there: so each normal is a linear least-squares fit of inverse depth, repeated without
// outliers where the first fit is bad.
std::vector<Eigen::Vector3f> EstimateNormals(const cv::Mat& filtered_depth,
                                             const RayTable& rays,
                                             int stride,
                                             const DepthFilterOptions& options);

}  // namespace semslam

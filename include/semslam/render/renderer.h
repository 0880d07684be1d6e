// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include <opencv2/core/mat.hpp>

#include "semslam/camera/pinhole_camera.h"
#include "semslam/geometry/rigid3.h"
#include "semslam/render/scene.h"

namespace semslam {

// What an ideal camera sees: no noise, no blur, nothing rounded.
struct IdealImage {
  cv::Mat radiance;  // CV_32FC3, BGR, linear, 1 = white paper in good light.
  cv::Mat depth;  // CV_64FC1, metres along the optical axis at the pixel's centre; 0 = nothing hit.
  cv::Mat labels;     // CV_16UC1, id of the instance at the pixel's centre; 0 = nothing hit.
  cv::Mat incidence;  // CV_32FC1, cosine between the line of sight and the surface's normal.
};

// Casts rays into a scene, one through each pixel as recorded (so that lens distortion is in the
// picture), and more where edges need smoothing. The same bytes on any number of threads.
// Render may be called from several threads at once.
class Renderer {
 public:
  struct Options {
    bool smooth_edges = true;       // Two rays more for colour in pixels that an edge crosses.
    bool shadows = true;            // Else every lamp reaches everything.
    double occlusion_reach = 0.25;  // Corners this near (m) darken a surface; 0 turns it off.
  };

  // The scene must outlive the renderer.
  Renderer(const Scene& scene, const Options& options);
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  // `rays`: of the camera; making them takes longer than using them, so they are made once.
  // `num_threads`: as ParallelFor.
  IdealImage Render(const RayTable& rays, const Rigid3& T_world_camera, int num_threads = 0) const;

 private:
  class Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "render/ray_scene.h"
#include "render/shading.h"

namespace semslam {

// The light that reaches every pixel of a picture: soft shadows and dark corners.
//
// Interleaved sampling (Keller and Heidrich, "Interleaved Sampling", 2001): one pixel in four sends
// a single ray to each lamp and one into its surroundings. Sixteen neighbours take sixteen
// different directions, and averaging over neighbours on the same surface gives each the light of
// all.
class LightBuffer {
 public:
  struct Options {
    bool shadows = true;
    float occlusion_reach = 0.25F;  // Metres; 0: none.
    int num_threads = 0;            // As ParallelFor.
  };

  // `surface`: the picture's points, row by row. All arguments must outlive the buffer.
  LightBuffer(const Scene& scene,
              const RayScene& ray_scene,
              std::span<const SurfacePoint> surface,
              int width,
              const Options& options);

  // Light at `point`, which is seen in or near this pixel.
  Lighting At(const SurfacePoint& point, int column, int row) const;

 private:
  void SampleRow(int row);
  void FilterRow(int row);
  const SurfacePoint& PointOf(int column, int row) const {
    return surface_[static_cast<std::size_t>(2 * row) * width_ + 2 * column];
  }

  const Scene& scene_;
  const RayScene& ray_scene_;
  std::span<const SurfacePoint> surface_;
  int width_;
  int num_columns_;  // Of this buffer: half the picture's.
  int num_rows_;
  Options options_;
  std::vector<Lighting> sampled_;
  std::vector<Lighting> filtered_;
};

}  // namespace semslam

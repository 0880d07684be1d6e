// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "render/lanes.h"
#include "render/ray_scene.h"
#include "render/shading.h"
#include "render/surface.h"

namespace semslam {

// The light that reaches every pixel of a picture: soft shadows and dark corners.
//
// Interleaved sampling (Keller and Heidrich, "Interleaved Sampling", 2001): one pixel in four sends
// a single ray to each lamp and one into its surroundings. Sixteen neighbours take sixteen
// different directions, and averaging over neighbours on the same surface gives each the light of
// all.
//
// A buffer can be used for one picture after the other, so that its memory is taken once.
class LightBuffer {
 public:
  struct Options {
    bool shadows = true;
    float occlusion_reach = 0.25F;  // Metres; 0: none.
  };
  // The points of a picture, row by row; `stride` (a multiple of 4, as all rows are padded to it)
  // from row to row.
  struct Picture {
    const SurfacePoints& points;
    int width;
    int height;
    int stride;
  };

  // Casts the rays and averages them. `num_threads`: as ParallelFor.
  void Fill(const Scene& scene,
            const RayScene& ray_scene,
            const Picture& picture,
            const Options& options,
            int num_threads);

  // Light at the pixels `column` (a multiple of 4) to `column` + 3 of a row. `points`, `index`:
  // what is seen there.
  Lighting AtPixels(const SurfacePoints& points, std::size_t index, int column, int row) const;
  // Light at four points, each seen in or near the pixel at its column and row.
  Lighting NearPixels(const SurfacePoints& points,
                      std::size_t index,
                      const std::array<int, 4>& columns,
                      const std::array<int, 4>& rows) const;

 private:
  // Rows have columns without a surface to their left and right.
  static constexpr int kMargin = 4;

  struct Casting;

  void Resize(const Picture& picture);
  void CopyRow(const Picture& picture, int row);
  void SampleRow(const Casting& casting, int row);
  void FilterRow(int row);
  std::size_t IndexOf(int column, int row) const {
    return static_cast<std::size_t>(row) * stride_ + kMargin + column;
  }

  int num_columns_ = 0;  // Half the picture's.
  int num_rows_ = 0;
  int stride_ = 0;
  bool is_even_ = true;  // All light everywhere: nothing cast.
  // Of one pixel in four. Where nothing is seen, normals are 0.
  VectorRow p_world_;
  VectorRow face_normal_;
  VectorRow normal_;
  FloatRow footprint_;
  std::array<FloatRow, kMaxLights + 1> sampled_;
  std::array<FloatRow, kMaxLights + 1> filtered_;
};

}  // namespace semslam

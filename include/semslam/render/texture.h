// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <emmintrin.h>
#include <opencv2/core/mat.hpp>

namespace semslam {

// A picture that repeats in both directions, with a pyramid so that it can be sampled at any
// distance without aliasing. An immutable value; safe to share between threads.
class Texture {
 public:
  // CV_8UC3, BGR, not empty; kept as given (gamma-coded).
  explicit Texture(const cv::Mat& image);

  // Colour (BGR, gamma-coded, 0 to 1) at (u, v), where the picture covers [0, 1) x [0, 1) with v
  // up, averaged over about `footprint` (width of the pixel's patch in units of the picture's
  // width).
  Eigen::Vector3f Sample(const Eigen::Vector2f& uv, float footprint) const;

  // The same at four places at once.
  struct Places {
    __m128 u;
    __m128 v;
    __m128 footprint;
  };
  struct Colors {
    __m128 blue;
    __m128 green;
    __m128 red;
  };
  Colors Sample(const Places& places) const;

 private:
  // Texels of B, G, R and a byte more. Behind the last column and row the first ones follow again.
  struct Level {
    float num_columns;
    float num_rows;
    std::vector<std::uint32_t> texels;
  };
  struct FourColors {
    __m128 at[4];  // B, G, R and a number more, for each of four places.
  };

  FourColors SampleLevels(__m128i indices, __m128 unit_x, __m128 unit_y) const;

  std::vector<Level> levels_;  // Each half as large as the one before.
};

}  // namespace semslam

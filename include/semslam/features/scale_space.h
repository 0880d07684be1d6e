// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cmath>

namespace semslam {

// The image pyramid in which features are found: level l is scale_factor^l times smaller than the
// image.
struct ScaleSpace {
  float scale_factor = 1.2F;
  int num_levels = 8;

  // Size of a pixel of a level in pixels of the image; the standard deviation of a feature's
  // position found there.
  float PixelSize(int octave) const { return std::pow(scale_factor, static_cast<float>(octave)); }
  double PixelVariance(int octave) const {
    const double size = PixelSize(octave);
    return size * size;
  }
};

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include <opencv2/core/mat.hpp>

namespace semslam {

// Direction from the centre of a disc of radius 15 px to its centre of intensity (Rosin 1999), as
// in ORB.
class IntensityCentroid {
 public:
  static constexpr int kRadius = 15;

  IntensityCentroid();

  // Degrees in [0, 360) as cv::fastAtan2 gives them; the disc must lie inside the image.
  float AngleDegrees(const cv::Mat& image, int x, int y) const;

 private:
  std::array<int, kRadius + 1> half_widths_{};  // Of the disc's row at distance v from the centre.
};

}  // namespace semslam

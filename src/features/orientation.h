// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <opencv2/core/mat.hpp>

namespace semslam {

// Direction from the centre of a disc of radius 15 px to its centre of intensity (Rosin 1999), as
// in ORB.
class IntensityCentroid {
 public:
  static constexpr int kRadius = 15;

  IntensityCentroid();

  // Degrees in [0, 360) as cv::fastAtan2 gives them; the disc must lie inside the image, and one
  // more pixel to its right.
  float AngleDegrees(const cv::Mat& image, int x, int y) const;

 private:
  // Bytes of a row of the disc: for vector instructions one more than its diameter.
  static constexpr int kRow = 2 * kRadius + 2;
  using Row = std::array<std::uint8_t, kRow>;

  struct Moments {
    int x = 0;
    int y = 0;
  };

  Moments MomentsAt(const std::uint8_t* center, std::ptrdiff_t step) const;

  // Of the disc's row at distance v from the centre: 255 inside of it, else 0.
  std::array<Row, kRadius + 1> masks_{};
};

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include <Eigen/Core>

#include "semslam/io/map_files.h"

namespace semslam {

// Points of a map as view.js reads them, 16 bytes each, little endian:
//   3 x u16  position, in steps from the low corner
//   u16      colour of the segment, 5-6-5 bits of red, green, blue
//   4 x u8   red, green, blue of the photo; class: place in the map's list from 1, 0 for none
//   2 x i8   normal, on the octahedron (Meyer et al., "On floating-point normal vectors", 2010)
//   u16      object: place in the map's list from 1, 0 for none
// in an order such that the first so many points are spread over the whole map.
struct PackedPoints {
  static constexpr std::size_t kBytesPerPoint = 16;
  std::string bytes;
  std::size_t num_points = 0;
  Eigen::Vector3d low = Eigen::Vector3d::Zero();  // World, metres.
  double step = 0;                                // Metres, the same on all axes.
  double spacing = 0;                             // Of neighbouring points, about, metres.
};

// Those with finite positions; if there are more than max_points, one of each cell of a grid that
// is wide enough.
PackedPoints PackPoints(const LabelledMapView& map, std::size_t max_points);

}  // namespace semslam

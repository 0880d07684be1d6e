// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <Eigen/Core>

namespace semslam {

struct BoundaryOptions {
  // Metres: points this near with another number make a point one of the boundary. Above the
  // distance of neighbouring points.
  double neighbour_distance = 0.015;
  double tolerance = 0.03;  // Metres: a boundary this near counts as found.
  int num_threads = 0;      // As ParallelFor.
  void Validate() const;    // Throws std::invalid_argument.
};

// Boundaries run where surfaces of different numbers touch; where there is a gap between them there
// is none to find. A cloud cut into crumbs has all of the true boundaries and many more, so recall
// says little without precision.
struct BoundaryScore {
  std::size_t num_true = 0;   // Points of true boundaries.
  std::size_t num_found = 0;  // Points of boundaries of segments.
  double recall = 1;          // Share of the true ones with a found one within the tolerance.
  double precision = 1;       // Share of the found ones with a true one within the tolerance.
};

// A segment and a true region for every point, as ScoreSegmentation takes them: points of region 0
// are left out, segment 0 is one more segment. Of points with the same numbers in a voxel of a
// third of the neighbour distance one counts, so that boundaries are measured by length, however
// dense.
BoundaryScore ScoreBoundaries(std::span<const Eigen::Vector3f> positions,
                              std::span<const std::uint32_t> segments,
                              std::span<const std::uint32_t> truth,
                              const BoundaryOptions& options = {});

}  // namespace semslam

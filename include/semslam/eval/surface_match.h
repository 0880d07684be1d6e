// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace semslam {

// Exact points on the true surface and what they belong to. All of the same length.
struct SurfaceSamples {
  std::span<const Eigen::Vector3f> positions;
  std::span<const Eigen::Vector3f> normals;  // Unit length; the side does not matter.
  std::span<const std::uint32_t> instances;  // Ids above 0.
};

struct SurfaceMatchOptions {
  double max_distance = 0.05;  // Metres: points farther from every sample are off the surface.
  // Metres along the surface for which a sample speaks: 1.5 times the samples' spacing. A point has
  // the distance of the disc of that radius around its nearest sample, so that the gaps between
  // samples are no error.
  double sample_reach = 0.0075;
  double completeness_distance = 0.02;  // Metres: samples this near to a point are mapped.
  int num_threads = 0;                  // As ParallelFor.
  void Validate() const;                // Throws std::invalid_argument.
};

// What is true of each point of a map.
struct SurfaceMatch {
  static constexpr std::uint32_t kOffSurface = 0;
  std::vector<std::uint32_t> instance_of_point;  // That of the nearest sample; kOffSurface.
  std::vector<float> distance_of_point;          // To the surface, metres; max_distance off it.
  std::size_t num_off_surface = 0;
  double completeness = 0;  // Share of the samples that are mapped; 1 without samples.

  double MedianDistance() const { return Quantile(0.5); }
  // The smallest distance that at least this share of the points does not exceed. 0 without points.
  double Quantile(double share) const;
};

// `points`: in the frame of the samples.
SurfaceMatch MatchToSurface(std::span<const Eigen::Vector3f> points,
                            const SurfaceSamples& surface,
                            const SurfaceMatchOptions& options = {});

}  // namespace semslam

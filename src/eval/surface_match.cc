// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/eval/surface_match.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "semslam/base/check.h"
#include "semslam/base/parallel.h"

#include "eval/point_grid.h"

namespace semslam {
namespace {

constexpr std::size_t kGrain = 4096;  // Points a thread takes at a time.

// Distance of a point from a disc that is given by its centre and normal.
double DistanceToDisc(const Eigen::Vector3d& to_center,
                      const Eigen::Vector3d& normal,
                      double radius) {
  const double height = normal.dot(to_center);
  const double aside = std::sqrt(std::max(0.0, to_center.squaredNorm() - height * height));
  return std::hypot(height, std::max(0.0, aside - radius));
}

double Completeness(std::span<const Eigen::Vector3f> points,
                    const SurfaceSamples& surface,
                    const SurfaceMatchOptions& options) {
  const std::size_t num_samples = surface.positions.size();
  if (num_samples == 0) return 1.0;
  const PointGrid grid(points, options.completeness_distance);
  std::vector<std::uint8_t> is_mapped(num_samples, 0);
  ParallelFor(num_samples, kGrain, options.num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      is_mapped[i] = grid.Any(surface.positions[i].cast<double>(), options.completeness_distance,
                              [](std::uint32_t) { return true; })
                         ? 1
                         : 0;
    }
  });
  return static_cast<double>(std::count(is_mapped.begin(), is_mapped.end(), 1)) /
         static_cast<double>(num_samples);
}

}  // namespace

void SurfaceMatchOptions::Validate() const {
  if (!(max_distance > 0) || !(sample_reach >= 0) || !(completeness_distance > 0)) {
    throw std::invalid_argument("distances of the surface match must be positive");
  }
}

double SurfaceMatch::Quantile(double share) const {
  if (distance_of_point.empty()) return 0;
  std::vector<float> distances = distance_of_point;
  const double rank = std::ceil(share * static_cast<double>(distances.size()));
  const auto nth = distances.begin() + static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  std::nth_element(distances.begin(), nth, distances.end());
  return *nth;
}

SurfaceMatch MatchToSurface(std::span<const Eigen::Vector3f> points,
                            const SurfaceSamples& surface,
                            const SurfaceMatchOptions& options) {
  options.Validate();
  SEMSLAM_CHECK(surface.normals.size() == surface.positions.size());
  SEMSLAM_CHECK(surface.instances.size() == surface.positions.size());
  constexpr double kCell = 0.01;  // Metres: a few samples each.
  const PointGrid grid(surface.positions, kCell);
  SurfaceMatch match;
  match.instance_of_point.assign(points.size(), SurfaceMatch::kOffSurface);
  match.distance_of_point.assign(points.size(), static_cast<float>(options.max_distance));
  ParallelFor(points.size(), kGrain, options.num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Eigen::Vector3d point = points[i].cast<double>();
      const auto nearest = grid.Nearest(point, options.max_distance);
      if (!nearest) continue;
      const std::uint32_t sample = nearest->index;
      match.instance_of_point[i] = surface.instances[sample];
      match.distance_of_point[i] = static_cast<float>(
          DistanceToDisc(surface.positions[sample].cast<double>() - point,
                         surface.normals[sample].cast<double>(), options.sample_reach));
    }
  });
  match.num_off_surface = static_cast<std::size_t>(std::count(
      match.instance_of_point.begin(), match.instance_of_point.end(), SurfaceMatch::kOffSurface));
  match.completeness = Completeness(points, surface, options);
  return match;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/eval/boundary_score.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "semslam/base/check.h"
#include "semslam/base/parallel.h"

#include "eval/point_grid.h"

namespace semslam {
namespace {

using Points = std::vector<Eigen::Vector3f>;
using Numbers = std::vector<std::uint32_t>;

constexpr std::size_t kGrain = 4096;

// The points for which the test holds, in their order.
template <typename Test>
Points Select(const Points& points, int num_threads, const Test& test) {
  std::vector<std::uint8_t> is_selected(points.size(), 0);
  ParallelFor(points.size(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) is_selected[i] = test(i) ? 1 : 0;
  });
  Points selected;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_selected[i] != 0) selected.push_back(points[i]);
  }
  return selected;
}

Points FindBoundary(const Points& points,
                    const Numbers& numbers,
                    const PointGrid& grid,
                    const BoundaryOptions& options) {
  return Select(points, options.num_threads, [&](std::size_t i) {
    return grid.Any(points[i].cast<double>(), options.neighbour_distance,
                    [&](std::uint32_t other) { return numbers[other] != numbers[i]; });
  });
}

double ShareNear(const Points& points, const Points& others, const BoundaryOptions& options) {
  if (points.empty()) return 1.0;
  const PointGrid grid(others, options.tolerance);
  const Points near = Select(points, options.num_threads, [&](std::size_t i) {
    return grid.Any(points[i].cast<double>(), options.tolerance,
                    [](std::uint32_t) { return true; });
  });
  return static_cast<double>(near.size()) / static_cast<double>(points.size());
}

// Points of known truth, the first of those in a voxel that have the same numbers.
std::vector<std::size_t> ThinnedOut(std::span<const Eigen::Vector3f> positions,
                                    std::span<const std::uint32_t> segments,
                                    std::span<const std::uint32_t> truth,
                                    const BoundaryOptions& options) {
  using Place = std::tuple<std::uint64_t, std::uint32_t, std::uint32_t>;
  std::vector<std::pair<Place, std::size_t>> places;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (truth[i] == 0) continue;
    const auto voxel =
        VoxelKey::Coordinates(positions[i].cast<double>(), options.neighbour_distance / 3);
    if (voxel) places.emplace_back(Place(VoxelKey::Pack(*voxel), segments[i], truth[i]), i);
  }
  std::sort(places.begin(), places.end());
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (k == 0 || places[k].first != places[k - 1].first) kept.push_back(places[k].second);
  }
  return kept;
}

}  // namespace

void BoundaryOptions::Validate() const {
  if (!(neighbour_distance > 0) || !(tolerance > 0)) {
    throw std::invalid_argument("distances of the boundary score must be positive");
  }
}

BoundaryScore ScoreBoundaries(std::span<const Eigen::Vector3f> positions,
                              std::span<const std::uint32_t> segments,
                              std::span<const std::uint32_t> truth,
                              const BoundaryOptions& options) {
  options.Validate();
  SEMSLAM_CHECK(segments.size() == positions.size());
  SEMSLAM_CHECK(truth.size() == positions.size());
  const std::vector<std::size_t> kept = ThinnedOut(positions, segments, truth, options);
  Points known;
  Numbers known_segments;
  Numbers known_regions;
  for (const std::size_t i : kept) {
    known.push_back(positions[i]);
    known_segments.push_back(segments[i]);
    known_regions.push_back(truth[i]);
  }
  const PointGrid grid(known, options.neighbour_distance);
  const Points true_boundary = FindBoundary(known, known_regions, grid, options);
  const Points found_boundary = FindBoundary(known, known_segments, grid, options);
  BoundaryScore score;
  score.num_true = true_boundary.size();
  score.num_found = found_boundary.size();
  score.recall = ShareNear(true_boundary, found_boundary, options);
  score.precision = ShareNear(found_boundary, true_boundary, options);
  return score;
}

}  // namespace semslam

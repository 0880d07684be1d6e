// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/plane_hypotheses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

#include "semslam/base/parallel.h"
#include "semslam/base/random.h"

#include "segmentation/patch_table.h"
#include "segmentation/plane_scores.h"

namespace semslam {
namespace {

constexpr std::size_t kMaxScoredPlanes = 4000;

void AddPlanesOfFlatPatches(const std::vector<Patch>& patches,
                            const PlaneHypothesisOptions& options,
                            int num_threads,
                            std::vector<Plane>& planes) {
  constexpr std::size_t kGrain = 256;
  std::vector<std::optional<PlaneFit>> fits(patches.size());
  ParallelFor(patches.size(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (patches[i].variation < options.max_variation) fits[i] = FitPlane(patches[i].moments);
    }
  });
  for (const std::optional<PlaneFit>& fit : fits) {
    if (fit) planes.push_back(fit->plane);
  }
}

// Nothing for centroids on a line.
std::optional<Plane> PlaneThrough(const Patch& a, const Patch& b, const Patch& c) {
  constexpr double kMinSine = 0.1;
  const Eigen::Vector3d u = b.centroid - a.centroid;
  const Eigen::Vector3d v = c.centroid - a.centroid;
  const Eigen::Vector3d normal = u.cross(v);
  if (!(normal.norm() > kMinSine * u.norm() * v.norm())) return std::nullopt;
  return Plane{normal.normalized(), -normal.normalized().dot(a.centroid)};
}

// Planes through three random patches, all of whose normals agree with it, that a fourth random
// patch confirms.
void AddRandomPlanes(const std::vector<Patch>& patches,
                     const PlaneHypothesisOptions& options,
                     std::vector<Plane>& planes) {
  if (patches.size() < 4) return;
  Random random(options.seed);
  const auto num_patches = static_cast<std::uint32_t>(patches.size());
  int num_found = 0;
  for (int trial = 0; trial < options.num_ransac_trials; ++trial) {
    std::array<const Patch*, 4> drawn{};
    for (const Patch*& patch : drawn) patch = &patches[random.Index(num_patches)];
    const std::optional<Plane> plane = PlaneThrough(*drawn[0], *drawn[1], *drawn[2]);
    if (!plane || drawn[3] == drawn[0] || drawn[3] == drawn[1] || drawn[3] == drawn[2]) continue;
    const bool is_confirmed = std::all_of(drawn.begin(), drawn.end(), [&](const Patch* patch) {
      return PatchCost(*patch, *plane, options.min_normal_cosine) <= options.tolerance / 2 &&
             std::abs(plane->normal.dot(patch->normal)) >= options.min_normal_cosine;
    });
    if (!is_confirmed) continue;
    planes.push_back(*plane);
    if (++num_found == options.max_ransac_planes) break;
  }
}

// Cell of a plane, the same for both signs: the axis the normal is nearest to, the two slopes
// against it (a cube's faces, so that there are no poles), and the offset.
using PlaneCell = std::tuple<int, std::int64_t, std::int64_t, std::int64_t>;

PlaneCell CellOf(const Plane& plane,
                 const Eigen::Vector3d& reference,
                 const PlaneHypothesisOptions& options) {
  int axis = 0;
  plane.normal.cwiseAbs().maxCoeff(&axis);
  const double sign = plane.normal[axis] < 0 ? -1.0 : 1.0;
  const auto slope = [&](int other) {
    // The arc tangent makes the cells evenly wide along the face.
    const double angle = std::atan(plane.normal[other] / plane.normal[axis]);
    return static_cast<std::int64_t>(std::floor(angle / options.merge_angle));
  };
  const double offset = sign * plane.SignedDistance(reference);
  return {axis, slope((axis + 1) % 3), slope((axis + 2) % 3),
          static_cast<std::int64_t>(std::floor(offset / options.merge_distance))};
}

Eigen::Vector3d MeanCentroid(const std::vector<Patch>& patches) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Patch& patch : patches) sum += patch.centroid;
  return sum / static_cast<double>(std::max<std::size_t>(patches.size(), 1));
}

template <typename T>
std::vector<T> Pick(const std::vector<T>& values, const std::vector<std::size_t>& indices) {
  std::vector<T> picked;
  picked.reserve(indices.size());
  for (const std::size_t index : indices) picked.push_back(values[index]);
  return picked;
}

// The best of every cell, best supported first, less those without the least support.
std::vector<Plane> Merge(const std::vector<Patch>& patches,
                         const PatchTable& table,
                         const std::vector<Plane>& planes,
                         const PlaneHypothesisOptions& options,
                         int num_threads) {
  const std::vector<double> supports = SoftSupports(table, planes, options, num_threads);
  std::vector<std::size_t> kept = BestOfCells(planes, supports, MeanCentroid(patches), options);
  std::erase_if(kept, [&](std::size_t index) { return supports[index] < options.min_area; });
  std::stable_sort(kept.begin(), kept.end(),
                   [&](std::size_t a, std::size_t b) { return supports[a] > supports[b]; });
  return Pick(planes, kept);
}

// Of planes in the order of their support, those that support at least the least area better than
// all before them do. The others could not lower the energy of the selection, but would make it
// quadratically dearer.
std::vector<Plane> KeepNovel(const std::vector<Patch>& patches,
                             const PatchTable& table,
                             const std::vector<Plane>& planes,
                             const PlaneHypothesisOptions& options) {
  const double max_cost = 20 * options.tolerance;
  std::vector<double> best(patches.size(), 0.0);
  std::vector<std::pair<std::size_t, double>> support;
  std::vector<Plane> kept;
  for (const Plane& plane : planes) {
    support.clear();
    double novel_area = 0;
    table.Visit(plane, {max_cost, options.min_normal_cosine}, [&](std::size_t i) {
      const double cost = PatchCost(patches[i], plane, options.min_normal_cosine);
      const double weight = std::exp(-cost / (2 * options.tolerance));
      if (weight <= best[i]) return;
      support.emplace_back(i, weight);
      novel_area += patches[i].area * (weight - best[i]);
    });
    if (novel_area < options.min_area) continue;
    for (const auto& [i, weight] : support) best[i] = weight;
    kept.push_back(plane);
  }
  return kept;
}

// Least-squares plane of the patches within the tolerance of `plane`, twice; `plane` itself where
// they leave it open.
Plane RefitPlane(const std::vector<Patch>& patches,
                 const PatchTable& table,
                 Plane plane,
                 const PlaneHypothesisOptions& options) {
  for (int iteration = 0; iteration < 2; ++iteration) {
    PointMoments moments;
    table.Visit(plane, {options.tolerance, options.min_normal_cosine}, [&](std::size_t i) {
      const Patch& patch = patches[i];
      if (std::abs(plane.SignedDistance(patch.centroid)) > options.tolerance) return;
      if (std::abs(plane.normal.dot(patch.normal)) < options.min_normal_cosine) return;
      moments += patch.moments;
    });
    const std::optional<PlaneFit> fit = FitPlane(moments);
    if (!fit) break;
    plane = fit->plane.normal.dot(plane.normal) < 0 ? fit->plane.Flipped() : fit->plane;
  }
  return plane;
}

}  // namespace

std::vector<std::size_t> BestOfCells(const std::vector<Plane>& planes,
                                     const std::vector<double>& supports,
                                     const Eigen::Vector3d& reference,
                                     const PlaneHypothesisOptions& options) {
  std::vector<PlaneCell> cells;
  cells.reserve(planes.size());
  for (const Plane& plane : planes) cells.push_back(CellOf(plane, reference, options));
  std::vector<std::size_t> order(planes.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tuple(cells[a], -supports[a], a) < std::tuple(cells[b], -supports[b], b);
  });
  std::vector<std::size_t> best;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || cells[order[i]] != cells[order[i - 1]]) best.push_back(order[i]);
  }
  std::sort(best.begin(), best.end());
  return best;
}

std::vector<Plane> ProposePlanes(const std::vector<Patch>& patches,
                                 const PlaneHypothesisOptions& options,
                                 int num_threads) {
  std::vector<Plane> planes;
  AddPlanesOfFlatPatches(patches, options, num_threads, planes);
  if (planes.size() > kMaxScoredPlanes) {  // Scoring them all would be quadratic in the scene.
    const std::vector<double> equal(planes.size(), 1.0);
    planes = Pick(planes, BestOfCells(planes, equal, MeanCentroid(patches), options));
  }
  AddRandomPlanes(patches, options, planes);
  const PatchTable table(patches);
  planes = Merge(patches, table, planes, options, num_threads);
  if (planes.size() > options.max_planes) planes.resize(options.max_planes);
  ParallelFor(planes.size(), 8, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      planes[i] = RefitPlane(patches, table, planes[i], options);
    }
  });
  planes = Merge(patches, table, planes, options, num_threads);
  return KeepNovel(patches, table, planes, options);
}

}  // namespace semslam

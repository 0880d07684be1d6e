// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/plane_scores.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "semslam/base/parallel.h"

namespace semslam {
namespace {

constexpr double kSupportScale = 10.0;  // D = -S / (kSupportScale * A_min).
// A little more than the double count, so that a plane without support of its own loses.
constexpr double kOverlapFactor = 1.05;

double SoftWeight(double cost, double tolerance) { return std::exp(-cost / (2 * tolerance)); }

double AngleTerm(const Plane& a, const Plane& b) {
  const double cosine = std::min(std::abs(a.normal.dot(b.normal)), 1.0);
  const double q = cosine < 0.5 ? cosine : 1.0 - cosine;
  return 0.5 * (1.0 - std::exp(-q / 0.25));
}

// Of the planes near one patch: their indices and what it gives them.
using PlaneWeights = std::vector<std::pair<Eigen::Index, double>>;

std::vector<PlaneWeights> WeighPlanes(const std::vector<Patch>& patches,
                                      std::span<const Plane> planes,
                                      const PlaneHypothesisOptions& options,
                                      int num_threads) {
  constexpr std::size_t kGrain = 256;
  const double unit = 1.0 / (kSupportScale * options.min_area);
  std::vector<PlaneWeights> weights(patches.size());
  ParallelFor(patches.size(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Patch& patch = patches[i];
      for (std::size_t m = 0; m < planes.size(); ++m) {
        const double cost = PatchCost(patch, planes[m], options.min_normal_cosine);
        if (cost > 20 * options.tolerance) continue;
        weights[i].emplace_back(m, unit * patch.area * SoftWeight(cost, options.tolerance));
      }
    }
  });
  return weights;
}

}  // namespace

std::vector<double> SoftSupports(const PatchTable& patches,
                                 std::span<const Plane> planes,
                                 const PlaneHypothesisOptions& options,
                                 int num_threads) {
  std::vector<double> supports(planes.size(), 0.0);
  ParallelFor(planes.size(), 16, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t m = first; m < last; ++m) {
      supports[m] = patches.SoftSupport(planes[m], options.tolerance, options.min_normal_cosine);
    }
  });
  return supports;
}

SelectionEnergy MakeSelectionEnergy(const std::vector<Patch>& patches,
                                    std::span<const Plane> planes,
                                    const PlaneHypothesisOptions& options,
                                    int num_threads) {
  const auto size = static_cast<Eigen::Index>(planes.size());
  SelectionEnergy energy{Eigen::VectorXd::Zero(size), Eigen::MatrixXd::Zero(size, size)};
  for (const PlaneWeights& weights : WeighPlanes(patches, planes, options, num_threads)) {
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const auto [m, weight_m] = weights[i];
      energy.unary[m] -= weight_m;
      for (std::size_t j = i + 1; j < weights.size(); ++j) {
        const auto [l, weight_l] = weights[j];
        energy.pairwise(m, l) += 0.5 * kOverlapFactor * std::min(weight_m, weight_l);
      }
    }
  }
  for (Eigen::Index m = 0; m < size; ++m) {
    for (Eigen::Index l = m + 1; l < size; ++l) {
      energy.pairwise(m, l) +=
          AngleTerm(planes[static_cast<std::size_t>(m)], planes[static_cast<std::size_t>(l)]);
      energy.pairwise(l, m) = energy.pairwise(m, l);
    }
  }
  return energy;
}

}  // namespace semslam

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

// What a patch gives to a plane near it.
struct PlaneWeight {
  Eigen::Index plane = 0;
  double weight = 0;
};

// Of the planes near each of some patches, in order.
struct PlaneWeights {
  std::vector<PlaneWeight> weights;
  std::vector<std::size_t> begin = {0};  // Of each patch's, and of the end.

  std::span<const PlaneWeight> Of(std::size_t patch) const {
    return std::span(weights).subspan(begin[patch], begin[patch + 1] - begin[patch]);
  }
};

PlaneWeights WeighPlanes(std::span<const Patch> patches,
                         std::span<const Plane> planes,
                         const PlaneHypothesisOptions& options) {
  const double unit = 1.0 / (kSupportScale * options.min_area);
  PlaneWeights result;
  for (const Patch& patch : patches) {
    for (std::size_t m = 0; m < planes.size(); ++m) {
      const double cost = PatchCost(patch, planes[m], options.min_normal_cosine);
      if (cost > 20 * options.tolerance) continue;
      result.weights.push_back(
          {static_cast<Eigen::Index>(m), unit * patch.area * SoftWeight(cost, options.tolerance)});
    }
    result.begin.push_back(result.weights.size());
  }
  return result;
}

// The same side by side, for chunks of the patches.
std::vector<PlaneWeights> WeighInChunks(std::span<const Patch> patches,
                                        std::span<const Plane> planes,
                                        const PlaneHypothesisOptions& options,
                                        int num_threads) {
  constexpr std::size_t kChunkSize = 256;
  std::vector<PlaneWeights> chunks((patches.size() + kChunkSize - 1) / kChunkSize);
  ParallelFor(chunks.size(), 1, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t chunk = first; chunk < last; ++chunk) {
      const auto rest = patches.subspan(chunk * kChunkSize);
      chunks[chunk] = WeighPlanes(rest.first(std::min(rest.size(), kChunkSize)), planes, options);
    }
  });
  return chunks;
}

// Adds what one patch gives to the planes, and what it gives to two of them at once.
void AddWeights(std::span<const PlaneWeight> weights, SelectionEnergy& energy) {
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const auto [m, weight_m] = weights[i];
    energy.unary[m] -= weight_m;
    for (const auto& [l, weight_l] : weights.subspan(i + 1)) {
      energy.pairwise(m, l) += 0.5 * kOverlapFactor * std::min(weight_m, weight_l);
    }
  }
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
  for (const PlaneWeights& chunk : WeighInChunks(patches, planes, options, num_threads)) {
    for (std::size_t i = 0; i + 1 < chunk.begin.size(); ++i) AddWeights(chunk.Of(i), energy);
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

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "semslam/geometry/plane.h"
#include "semslam/segmentation/options.h"

#include "segmentation/patch_table.h"
#include "segmentation/patches.h"

namespace semslam {

// Cost of plane m for patch i (Pham et al., IROS 2016):
//   k_im = |n_m . c_i + d_m|, times 100 if |n_i . n_m| is below the least cosine, in metres.
inline double PatchCost(const Patch& patch, const Plane& plane, double min_normal_cosine) {
  constexpr double kWrongNormalFactor = 100.0;
  const double distance = std::abs(plane.SignedDistance(patch.centroid));
  const bool agrees = std::abs(plane.normal.dot(patch.normal)) >= min_normal_cosine;
  return agrees ? distance : kWrongNormalFactor * distance;
}

// Soft support S_m = sum_i a_i exp(-k_im / (2 tau)) of each plane, square metres.
std::vector<double> SoftSupports(const PatchTable& patches,
                                 std::span<const Plane> planes,
                                 const PlaneHypothesisOptions& options,
                                 int num_threads);

// Energy E(x) = sum_m D_m x_m + sum_ml W_ml x_m x_l over the sets x of planes; W symmetric, zero on
// the diagonal.
struct SelectionEnergy {
  Eigen::VectorXd unary;
  Eigen::MatrixXd pairwise;
};

// D_m = -S_m / (10 A_min). W_ml is the sum of
//   0.5 (1 - exp(-q / 0.25)), q = a if a < 0.5 else 1 - a, a = |n_m . n_l|: planes of one scene are
//   parallel or square to each other, and
//   half of the support that both count, in the units of D: what one plane explains, another
//   explains no second time.
SelectionEnergy MakeSelectionEnergy(const std::vector<Patch>& patches,
                                    std::span<const Plane> planes,
                                    const PlaneHypothesisOptions& options,
                                    int num_threads);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "semslam/optim/bundle_adjuster.h"

namespace semslam::testing {

struct CeresSolution {
  std::vector<Rigid3> T_world_camera;
  std::vector<Eigen::Vector3d> p_world;
  double cost = 0;  // Sum of (robust) squared errors.
};

struct CeresVariant {
  bool robust = false;
  bool fix_points = false;
};

// The same minimum found by Ceres with automatic derivatives: an implementation that shares nothing
// with the one under test. Runs until nothing changes.
CeresSolution SolveWithCeres(const BundleProblem& problem,
                             const Chi2Limits& limits,
                             const CeresVariant& variant);

}  // namespace semslam::testing

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "semslam/camera/pinhole_camera.h"
#include "semslam/geometry/rigid3.h"
#include "semslam/geometry/rigid_ransac.h"

namespace semslam {

struct PixelConsensus {
  Rigid3 T_world_camera;
  std::vector<std::uint8_t> is_inlier;  // One a pair.
};

// The pose from which most of the points appear within `max_error_px` of their undistorted pixels,
// found from random samples (P3P in RANSAC). For frames without depth: with depth,
// FindRigidConsensus has no ambiguity. Nothing if fewer than options.min_inliers agree.
std::optional<PixelConsensus> FindPoseFromPixels(const PinholeCamera& camera,
                                                 std::span<const Eigen::Vector3d> p_world,
                                                 std::span<const Eigen::Vector2d> pixels,
                                                 double max_error_px,
                                                 const RansacOptions& options);

}  // namespace semslam

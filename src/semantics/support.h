// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "semslam/dense/map_cloud.h"
#include "semslam/dense/voxel_index.h"
#include "semslam/geometry/oriented_box.h"
#include "semslam/geometry/plane.h"
#include "semslam/segmentation/segmenter.h"

namespace semslam {

// Finds what things stand on, and their boxes. The world is the first camera's frame, up what
// CommonUpNormal says.
class SupportFinder {
 public:
  // The arguments must outlive this object.
  SupportFinder(const MapCloud& cloud, const VoxelIndex& index, const Segmentation& segmentation);

  // Nothing if the map has nothing level.
  const std::optional<Eigen::Vector3d>& up() const { return up_; }

  // The segment below or beside the lowest points of a thing that most of them touch; 0 if there
  // is none. `own`: the thing's segments, ascending.
  SegmentId FindSupport(std::span<const Eigen::Vector3d> points,
                        std::span<const SegmentId> own) const;

  // Upright if up is known, down to the support if that is a level plane, and whole where only the
  // front of a round thing was seen; else along the principal directions.
  OrientedBox FitBox(std::span<const Eigen::Vector3d> points, SegmentId support) const;

 private:
  // From a low point of a thing to the places around it at which to look for what carries it.
  std::vector<Eigen::Vector3d> OffsetsToSupport() const;
  std::optional<Plane> LevelPlaneOf(SegmentId segment) const;

  const VoxelIndex& index_;
  const Segmentation& segmentation_;
  std::optional<Eigen::Vector3d> up_;
};

}  // namespace semslam

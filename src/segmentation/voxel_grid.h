// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "semslam/segmentation/segmenter.h"

namespace semslam {

constexpr std::uint32_t kNoVoxel = std::numeric_limits<std::uint32_t>::max();

// The occupied voxels of a cloud in flat arrays, sorted by key, so that the order of the points has
// no effect. Coordinates are relative to `origin`, the low corner of the cloud.
struct VoxelGrid {
  double voxel_size = 0;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::vector<std::uint64_t> keys;            // Ascending; from high to low bits z, y, x.
  std::vector<Eigen::Vector3i> cells;         // Position in the grid.
  std::vector<Eigen::Vector3f> centroids;     // Of the points inside.
  std::vector<Eigen::Vector3f> views;         // Mean side that was seen; zero if unknown.
  std::vector<std::uint32_t> voxel_of_point;  // kNoVoxel for points that are left out.
  // The occupied ones of the 26 neighbours of voxel v, ascending:
  // neighbours[neighbour_begin[v] .. neighbour_begin[v + 1]).
  std::vector<std::uint32_t> neighbour_begin;
  std::vector<std::uint32_t> neighbours;

  std::size_t size() const { return keys.size(); }
  std::span<const std::uint32_t> NeighboursOf(std::size_t voxel) const {
    return std::span(neighbours)
        .subspan(neighbour_begin[voxel], neighbour_begin[voxel + 1] - neighbour_begin[voxel]);
  }
};

VoxelGrid BuildVoxelGrid(const PointCloudView& cloud, double voxel_size, int num_threads);

// The same, with voxels enlarged by steps, up to `max_growth`, until those of a surface touch: a
// cloud of a coarser spacing would fall into stripes.
VoxelGrid BuildConnectedVoxelGrid(const PointCloudView& cloud,
                                  double voxel_size,
                                  double max_growth,
                                  int num_threads);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "semslam/base/large_vector.h"
#include "semslam/segmentation/segmenter.h"

namespace semslam {

constexpr std::uint32_t kNoVoxel = std::numeric_limits<std::uint32_t>::max();

// Where the fields of a voxel's key begin. One free cell on either side of the cloud keeps the keys
// of neighbours apart from those of other rows.
struct VoxelKeyLayout {
  int shift_y = 0;
  int shift_z = 0;
  int num_bits = 0;

  std::uint64_t Key(const Eigen::Vector3i& cell) const {
    return static_cast<std::uint64_t>(cell.z()) << shift_z |
           static_cast<std::uint64_t>(cell.y()) << shift_y | static_cast<std::uint64_t>(cell.x());
  }
  Eigen::Vector3i CellOf(std::uint64_t key) const {
    return {
        static_cast<std::int32_t>(key & ((std::uint64_t{1} << shift_y) - 1)),
        static_cast<std::int32_t>(key >> shift_y & ((std::uint64_t{1} << (shift_z - shift_y)) - 1)),
        static_cast<std::int32_t>(key >> shift_z)};
  }
};

// For every voxel the occupied ones of its 26 neighbours, ascending. Kept in chunks, each made by
// one thread.
class VoxelNeighbours {
 public:
  static constexpr std::size_t kChunkSize = 32768;  // Voxels.
  struct Chunk {
    std::vector<std::uint32_t> begin;  // Of each voxel's, and of the end.
    LargeVector<std::uint32_t> indices;
  };

  VoxelNeighbours() = default;
  explicit VoxelNeighbours(std::vector<Chunk> chunks) : chunks_(std::move(chunks)) {}

  std::span<const std::uint32_t> Of(std::size_t voxel) const {
    const Chunk& chunk = chunks_[voxel / kChunkSize];
    const std::uint32_t* const begin = chunk.begin.data() + voxel % kChunkSize;
    return std::span(chunk.indices).subspan(begin[0], begin[1] - begin[0]);
  }
  // Of all voxels.
  std::size_t size() const {
    std::size_t sum = 0;
    for (const Chunk& chunk : chunks_) sum += chunk.indices.size();
    return sum;
  }

 private:
  std::vector<Chunk> chunks_;
};

// The occupied voxels of a cloud in flat arrays, sorted by key, so that the order of the points has
// no effect. Coordinates are relative to `origin`, the low corner of the cloud.
struct VoxelGrid {
  double voxel_size = 0;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  VoxelKeyLayout layout;
  LargeVector<std::uint64_t> keys;            // Ascending; from high to low bits z, y, x.
  LargeVector<Eigen::Vector3f> centroids;     // Of the points inside.
  LargeVector<Eigen::Vector3f> views;         // Mean side that was seen; zero if unknown.
  LargeVector<std::uint32_t> voxel_of_point;  // kNoVoxel for points that are left out.
  VoxelNeighbours neighbours;
  // Which of the 27 cells around voxel v are occupied: bit NeighbourBit of the step, its own too.
  LargeVector<std::uint32_t> neighbour_bits;

  // Ascending as the neighbours do.
  static constexpr int NeighbourBit(int dx, int dy, int dz) {
    return 9 * (dz + 1) + 3 * (dy + 1) + dx + 1;
  }

  // Without the instruction for it, which not every x86-64 has.
  static constexpr int CountBits(std::uint32_t bits) {
    bits -= bits >> 1 & 0x55555555U;
    bits = (bits & 0x33333333U) + (bits >> 2 & 0x33333333U);
    bits = (bits + (bits >> 4)) & 0x0f0f0f0fU;
    return static_cast<int>(bits * 0x01010101U >> 24);
  }

  std::size_t size() const { return centroids.size(); }
  Eigen::Vector3i CellOf(std::size_t voxel) const { return layout.CellOf(keys[voxel]); }
  std::span<const std::uint32_t> NeighboursOf(std::size_t voxel) const {
    return neighbours.Of(voxel);
  }
  // Those of them that come before the voxel itself.
  std::span<const std::uint32_t> LowerNeighboursOf(std::size_t voxel) const {
    constexpr std::uint32_t kLower = (std::uint32_t{1} << NeighbourBit(0, 0, 0)) - 1;
    return NeighboursOf(voxel).first(
        static_cast<std::size_t>(CountBits(neighbour_bits[voxel] & kLower)));
  }
  // The voxel at a NeighbourBit other than the middle one; kNoVoxel if there is none.
  std::uint32_t NeighbourAt(std::size_t voxel, int bit) const {
    constexpr int kOwn = NeighbourBit(0, 0, 0);
    const std::uint32_t bits = neighbour_bits[voxel];
    if ((bits >> bit & 1) == 0) return kNoVoxel;
    const int rank = CountBits(bits & ((std::uint32_t{1} << bit) - 1)) - (bit > kOwn ? 1 : 0);
    return neighbours.Of(voxel)[static_cast<std::size_t>(rank)];
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

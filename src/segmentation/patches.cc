// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/patches.h"

#include <algorithm>
#include <bit>
#include <optional>

#include "segmentation/radix_sort.h"

namespace semslam {
namespace {

std::vector<Patch> MakePatches(const VoxelGrid& grid,
                               const std::vector<Eigen::Vector3f>& normals,
                               const Supervoxels& supervoxels) {
  std::vector<Patch> patches(supervoxels.num_patches);
  for (std::size_t voxel = 0; voxel < grid.size(); ++voxel) {
    const std::uint32_t index = supervoxels.patch_of_voxel[voxel];
    if (index == kNoPatch) continue;
    Patch& patch = patches[index];
    patch.moments.Add(grid.centroids[voxel].cast<double>());
    patch.normal += normals[voxel].cast<double>();
    ++patch.num_voxels;
  }
  for (Patch& patch : patches) {
    patch.centroid = patch.moments.Mean();
    patch.normal.normalize();  // Leaves a zero vector as it is.
    if (const std::optional<PlaneFit> fit = FitPlane(patch.moments)) {
      patch.variation = fit->variation;
    }
    patch.area = AreaOfVoxels(patch.num_voxels, grid.voxel_size, patch.normal);
  }
  return patches;
}

std::vector<PatchEdge> FindEdges(const VoxelGrid& grid, const Supervoxels& supervoxels) {
  std::vector<KeyedIndex> contacts;
  for (std::size_t voxel = 0; voxel < grid.size(); ++voxel) {
    const std::uint32_t a = supervoxels.patch_of_voxel[voxel];
    if (a == kNoPatch) continue;
    for (const std::uint32_t other : grid.NeighboursOf(voxel)) {
      const std::uint32_t b = supervoxels.patch_of_voxel[other];
      // Both directions of a pair of voxels are seen; the one from the lower patch counts.
      if (b == kNoPatch || b <= a) continue;
      contacts.push_back({std::uint64_t{a} * supervoxels.num_patches + b, 0});
    }
  }
  const std::uint64_t num_pairs = std::uint64_t{supervoxels.num_patches} * supervoxels.num_patches;
  RadixSort(contacts, static_cast<int>(std::bit_width(num_pairs)));
  std::vector<PatchEdge> edges;
  for (std::size_t begin = 0, end = 0; begin < contacts.size(); begin = end) {
    const std::uint64_t key = contacts[begin].key;
    while (end < contacts.size() && contacts[end].key == key) ++end;
    edges.push_back({static_cast<std::uint32_t>(key / supervoxels.num_patches),
                     static_cast<std::uint32_t>(key % supervoxels.num_patches),
                     static_cast<std::uint32_t>(end - begin)});
  }
  return edges;
}

}  // namespace

PatchGraph BuildPatchGraph(const VoxelGrid& grid,
                           const std::vector<Eigen::Vector3f>& normals,
                           const Supervoxels& supervoxels) {
  return {MakePatches(grid, normals, supervoxels), FindEdges(grid, supervoxels)};
}

double AreaOfVoxels(std::size_t num_voxels, double voxel_size, const Eigen::Vector3d& normal) {
  const double crossings = std::max(normal.lpNorm<1>(), 1.0);
  return static_cast<double>(num_voxels) * voxel_size * voxel_size / crossings;
}

}  // namespace semslam

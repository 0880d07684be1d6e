// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/patches.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
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
  }
  return patches;
}

// The area of a patch is that of its shadow along the axis its normal is nearest to, over the
// cosine between them. The shadow counts columns of voxels, so that a surface that noise has made
// several voxels thick is counted once.
void MeasureAreas(const VoxelGrid& grid,
                  const Supervoxels& supervoxels,
                  std::vector<Patch>& patches) {
  std::vector<std::size_t> place(patches.size() + 1, 0);
  for (std::size_t i = 0; i < patches.size(); ++i) place[i + 1] = place[i] + patches[i].num_voxels;
  std::vector<std::uint64_t> columns(place.back());
  std::vector<int> axes(patches.size(), 0);
  for (std::size_t i = 0; i < patches.size(); ++i) {
    patches[i].normal.cwiseAbs().maxCoeff(&axes[i]);
  }
  for (std::size_t voxel = 0; voxel < grid.size(); ++voxel) {
    const std::uint32_t index = supervoxels.patch_of_voxel[voxel];
    if (index == kNoPatch) continue;
    const Eigen::Vector3i& cell = grid.cells[voxel];
    const int axis = axes[index];
    columns[place[index]++] = static_cast<std::uint64_t>(cell[(axis + 1) % 3]) << 32 |
                              static_cast<std::uint64_t>(cell[(axis + 2) % 3]);
  }
  const double face = grid.voxel_size * grid.voxel_size;
  for (std::size_t i = 0; i < patches.size(); ++i) {  // place[i] is now the end of patch i.
    const auto end = columns.begin() + static_cast<std::ptrdiff_t>(place[i]);
    const auto begin = end - static_cast<std::ptrdiff_t>(patches[i].num_voxels);
    std::sort(begin, end);
    const auto num_columns = static_cast<double>(std::unique(begin, end) - begin);
    const double cosine = std::abs(patches[i].normal[axes[i]]);
    patches[i].area = num_columns * face / (cosine > 0 ? cosine : 1.0);
  }
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
  PatchGraph graph{MakePatches(grid, normals, supervoxels), FindEdges(grid, supervoxels)};
  MeasureAreas(grid, supervoxels, graph.patches);
  return graph;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/patches.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <optional>

#include "semslam/base/parallel.h"

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

// The voxel one step along an axis, if it is occupied.
std::uint32_t StepAlong(const VoxelGrid& grid, std::uint32_t voxel, int axis, int direction) {
  const Eigen::Vector3i target = grid.cells[voxel] + direction * Eigen::Vector3i::Unit(axis);
  for (const std::uint32_t other : grid.NeighboursOf(voxel)) {
    if (grid.cells[other] == target) return other;
  }
  return kNoVoxel;
}

// Number of voxels of the surface that stand in one column with `voxel`, which is one of them.
int CountColumn(const VoxelGrid& grid,
                const std::vector<Eigen::Vector3f>& normals,
                const Eigen::Vector3f& patch_normal,
                std::uint32_t voxel,
                int axis) {
  constexpr float kMinCosine = 0.7F;  // Other voxels belong to another surface that ends here.
  constexpr int kMaxSteps = 8;
  int count = 1;
  for (const int direction : {-1, 1}) {
    std::uint32_t next = StepAlong(grid, voxel, axis, direction);
    for (int i = 0; i < kMaxSteps && next != kNoVoxel; ++i) {
      if (normals[next].dot(patch_normal) < kMinCosine) break;
      ++count;
      next = StepAlong(grid, next, axis, direction);
    }
  }
  return count;
}

// The area of a patch is that of its shadow along the axis its normal is nearest to, over the
// cosine between them. A column of the shadow is shared by all voxels of the surface in it, so that
// a surface that noise has made several voxels thick is counted once.
void MeasureAreas(const VoxelGrid& grid,
                  const std::vector<Eigen::Vector3f>& normals,
                  const Supervoxels& supervoxels,
                  int num_threads,
                  std::vector<Patch>& patches) {
  std::vector<float> shares(grid.size());
  ParallelFor(grid.size(), 8192, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t voxel = first; voxel < last; ++voxel) {
      const std::uint32_t index = supervoxels.patch_of_voxel[voxel];
      if (index == kNoPatch) continue;
      const Eigen::Vector3f normal = patches[index].normal.cast<float>();
      int axis = 0;
      const float cosine = normal.cwiseAbs().maxCoeff(&axis);
      const int count = CountColumn(grid, normals, normal, static_cast<std::uint32_t>(voxel), axis);
      shares[voxel] = 1.0F / (static_cast<float>(count) * (cosine > 0 ? cosine : 1.0F));
    }
  });
  const double face = grid.voxel_size * grid.voxel_size;
  for (std::size_t voxel = 0; voxel < grid.size(); ++voxel) {
    const std::uint32_t index = supervoxels.patch_of_voxel[voxel];
    if (index != kNoPatch) patches[index].area += face * static_cast<double>(shares[voxel]);
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
                           const Supervoxels& supervoxels,
                           int num_threads) {
  PatchGraph graph{MakePatches(grid, normals, supervoxels), FindEdges(grid, supervoxels)};
  MeasureAreas(grid, normals, supervoxels, num_threads, graph.patches);
  return graph;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/patches.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "semslam/base/parallel.h"

#include "segmentation/key_numbers.h"

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

// Number of voxels of the surface that stand in one column with `voxel`, which is one of them.
int CountColumn(const VoxelGrid& grid,
                const std::vector<Eigen::Vector3f>& normals,
                const Eigen::Vector3f& patch_normal,
                std::uint32_t voxel,
                int axis) {
  constexpr float kMinCosine = 0.7F;  // Other voxels belong to another surface that ends here.
  constexpr int kMaxSteps = 8;
  constexpr std::array<int, 3> kStrides = {1, 3, 9};
  int count = 1;
  for (const int direction : {-1, 1}) {
    const int bit = VoxelGrid::NeighbourBit(0, 0, 0) + direction * kStrides[axis];
    std::uint32_t next = grid.NeighbourAt(voxel, bit);
    for (int i = 0; i < kMaxSteps && next != kNoVoxel; ++i) {
      if (normals[next].dot(patch_normal) < kMinCosine) break;
      ++count;
      next = grid.NeighbourAt(next, bit);
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
  constexpr std::size_t kUsualEdges = 4;  // A patch.
  KeyNumbers pairs(kUsualEdges * supervoxels.num_patches);
  std::vector<std::uint32_t> num_contacts;
  for (std::size_t voxel = 0; voxel < grid.size(); ++voxel) {
    const std::uint32_t a = supervoxels.patch_of_voxel[voxel];
    if (a == kNoPatch) continue;
    for (const std::uint32_t other : grid.NeighboursOf(voxel)) {
      const std::uint32_t b = supervoxels.patch_of_voxel[other];
      // Both directions of a pair of voxels are seen; the one from the lower patch counts.
      if (b == kNoPatch || b <= a) continue;
      const std::uint32_t pair = pairs.Insert(std::uint64_t{a} << 32 | b);
      if (pair == num_contacts.size()) num_contacts.push_back(0);
      ++num_contacts[pair];
    }
  }
  std::vector<PatchEdge> edges;
  edges.reserve(num_contacts.size());
  for (std::size_t i = 0; i < num_contacts.size(); ++i) {
    const std::uint64_t key = pairs.keys()[i];
    edges.push_back(
        {static_cast<std::uint32_t>(key >> 32), static_cast<std::uint32_t>(key), num_contacts[i]});
  }
  std::sort(edges.begin(), edges.end(), [](const PatchEdge& first, const PatchEdge& second) {
    return std::pair(first.a, first.b) < std::pair(second.a, second.b);
  });
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

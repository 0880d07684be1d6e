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

// Only the upper triangle of the outer products is summed on the way.
struct PatchSums {
  double count = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  Eigen::Vector3d products = Eigen::Vector3d::Zero();  // yz, zx, xy.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();

  PointMoments ToMoments() const {
    PointMoments moments;
    moments.weight = count;
    moments.sum = sum;
    moments.outer << squares.x(), products.z(), products.y(),  //
        products.z(), squares.y(), products.x(),               //
        products.y(), products.x(), squares.z();
    return moments;
  }
};

std::vector<Patch> MakePatches(const VoxelGrid& grid,
                               const std::vector<Eigen::Vector3f>& normals,
                               const Supervoxels& supervoxels,
                               int num_threads) {
  std::vector<PatchSums> sums(supervoxels.num_patches);
  for (std::size_t voxel = 0; voxel < grid.size(); ++voxel) {
    const std::uint32_t index = supervoxels.patch_of_voxel[voxel];
    if (index == kNoPatch) continue;
    PatchSums& patch = sums[index];
    const Eigen::Vector3d p = grid.centroids[voxel].cast<double>();
    patch.count += 1;
    patch.sum += p;
    patch.squares += p.cwiseProduct(p);
    patch.products += Eigen::Vector3d(p.y() * p.z(), p.z() * p.x(), p.x() * p.y());
    patch.normal += normals[voxel].cast<double>();
  }
  std::vector<Patch> patches(supervoxels.num_patches);
  ParallelFor(patches.size(), 256, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      Patch& patch = patches[i];
      patch.moments = sums[i].ToMoments();
      patch.num_voxels = static_cast<std::size_t>(sums[i].count);
      patch.centroid = patch.moments.Mean();
      patch.normal = sums[i].normal.normalized();  // Leaves a zero vector as it is.
      if (const std::optional<PlaneFit> fit = FitPlane(patch.moments)) {
        patch.variation = fit->variation;
      }
    }
  });
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

// Contacts between patches, counted: the pairs (lower patch in the high bits) and how often each.
struct Contacts {
  KeyNumbers pairs{0};
  std::vector<std::uint32_t> counts;

  void Add(std::uint64_t pair, std::uint32_t count) {
    const std::uint32_t number = pairs.Insert(pair);
    if (number == counts.size()) counts.push_back(0);
    counts[number] += count;
  }
};

void CountContacts(const VoxelGrid& grid,
                   const Supervoxels& supervoxels,
                   std::size_t first,
                   std::size_t last,
                   Contacts& contacts) {
  for (std::size_t voxel = first; voxel < last; ++voxel) {
    const std::uint32_t a = supervoxels.patch_of_voxel[voxel];
    if (a == kNoPatch) continue;
    for (const std::uint32_t other : grid.NeighboursOf(voxel)) {
      const std::uint32_t b = supervoxels.patch_of_voxel[other];
      // Both directions of a pair of voxels are seen; the one from the lower patch counts.
      if (b != kNoPatch && b > a) contacts.Add(std::uint64_t{a} << 32 | b, 1);
    }
  }
}

std::vector<PatchEdge> FindEdges(const VoxelGrid& grid,
                                 const Supervoxels& supervoxels,
                                 int num_threads) {
  constexpr std::size_t kNumChunks = 8;
  std::vector<Contacts> contacts(kNumChunks);
  ParallelFor(kNumChunks, 1, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t chunk = begin; chunk < end; ++chunk) {
      CountContacts(grid, supervoxels, grid.size() * chunk / kNumChunks,
                    grid.size() * (chunk + 1) / kNumChunks, contacts[chunk]);
    }
  });
  Contacts all;
  for (const Contacts& chunk : contacts) {
    for (std::size_t i = 0; i < chunk.counts.size(); ++i) {
      all.Add(chunk.pairs.keys()[i], chunk.counts[i]);
    }
  }
  std::vector<PatchEdge> edges;
  edges.reserve(all.counts.size());
  for (std::size_t i = 0; i < all.counts.size(); ++i) {
    const std::uint64_t pair = all.pairs.keys()[i];
    edges.push_back(
        {static_cast<std::uint32_t>(pair >> 32), static_cast<std::uint32_t>(pair), all.counts[i]});
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
  PatchGraph graph{MakePatches(grid, normals, supervoxels, num_threads),
                   FindEdges(grid, supervoxels, num_threads)};
  MeasureAreas(grid, normals, supervoxels, num_threads, graph.patches);
  return graph;
}

}  // namespace semslam

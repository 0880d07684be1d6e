// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/patches.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "semslam/base/key_numbers.h"
#include "semslam/base/parallel.h"

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

// Which patches are to be made, and from which voxels.
struct Work {
  const VoxelGrid& grid;
  const std::vector<Eigen::Vector3f>& normals;
  const Supervoxels& supervoxels;
  const std::vector<std::uint8_t> is_open;  // By patch. Not of bool: it is read all the time.
  int num_threads;

  // kNoPatch for a voxel that counts for none.
  std::uint32_t OpenPatchOf(std::size_t voxel) const {
    const std::uint32_t patch = supervoxels.patch_of_voxel[voxel];
    return patch == kNoPatch || is_open[patch] == 0 ? kNoPatch : patch;
  }
};

void MakePatches(const Work& work, std::vector<Patch>& patches) {
  const VoxelGrid& grid = work.grid;
  std::vector<PatchSums> sums(patches.size());
  for (std::size_t voxel = 0; voxel < grid.size(); ++voxel) {
    const std::uint32_t index = work.OpenPatchOf(voxel);
    if (index == kNoPatch) continue;
    PatchSums& patch = sums[index];
    const Eigen::Vector3d p = grid.centroids[voxel].cast<double>();
    patch.count += 1;
    patch.sum += p;
    patch.squares += p.cwiseProduct(p);
    patch.products += Eigen::Vector3d(p.y() * p.z(), p.z() * p.x(), p.x() * p.y());
    patch.normal += work.normals[voxel].cast<double>();
  }
  ParallelFor(patches.size(), 256, work.num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (work.is_open[i] == 0) continue;
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
void MeasureAreas(const Work& work, std::vector<Patch>& patches) {
  const VoxelGrid& grid = work.grid;
  std::vector<float> shares(grid.size());
  ParallelFor(grid.size(), 8192, work.num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t voxel = first; voxel < last; ++voxel) {
      const std::uint32_t index = work.OpenPatchOf(voxel);
      if (index == kNoPatch) continue;
      const Eigen::Vector3f normal = patches[index].normal.cast<float>();
      int axis = 0;
      const float cosine = normal.cwiseAbs().maxCoeff(&axis);
      const int count =
          CountColumn(grid, work.normals, normal, static_cast<std::uint32_t>(voxel), axis);
      shares[voxel] = 1.0F / (static_cast<float>(count) * (cosine > 0 ? cosine : 1.0F));
    }
  });
  const double face = grid.voxel_size * grid.voxel_size;
  for (std::size_t voxel = 0; voxel < grid.size(); ++voxel) {
    const std::uint32_t index = work.OpenPatchOf(voxel);
    if (index != kNoPatch) patches[index].area += face * static_cast<double>(shares[voxel]);
  }
}

// Contacts between patches, counted: the pairs (lower patch in the high bits) and how often each.
struct Contacts {
  KeyNumbers pairs{0};
  std::vector<std::uint32_t> counts;
  std::uint64_t last_pair = 0;  // Is none: the lower patch comes first.
  std::uint32_t last_number = 0;

  void Add(std::uint64_t pair, std::uint32_t count) {
    if (pair != last_pair) {  // Mostly it is the same.
      last_pair = pair;
      last_number = pairs.Insert(pair);
      if (last_number == counts.size()) counts.push_back(0);
    }
    counts[last_number] += count;
  }
};

// Of open patches, among each other and with the others.
void CountContacts(const Work& work, std::size_t first, std::size_t last, Contacts& contacts) {
  const std::vector<std::uint32_t>& patch_of_voxel = work.supervoxels.patch_of_voxel;
  for (std::size_t voxel = first; voxel < last; ++voxel) {
    const std::uint32_t a = work.OpenPatchOf(voxel);
    if (a == kNoPatch) continue;
    for (const std::uint32_t other : work.grid.NeighboursOf(voxel)) {
      const std::uint32_t b = patch_of_voxel[other];
      if (b == a || b == kNoPatch) continue;
      // Between open patches both directions of a pair of voxels are seen: that from the lower
      // patch counts.
      if (b > a) {
        contacts.Add(std::uint64_t{a} << 32 | b, 1);
      } else if (work.is_open[b] == 0) {
        contacts.Add(std::uint64_t{b} << 32 | a, 1);
      }
    }
  }
}

// Adds those of open patches to `edges`.
void FindEdges(const Work& work, std::vector<PatchEdge>& edges) {
  constexpr std::size_t kNumChunks = 8;
  const std::size_t size = work.grid.size();
  std::vector<Contacts> contacts(kNumChunks);
  ParallelFor(kNumChunks, 1, work.num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t chunk = begin; chunk < end; ++chunk) {
      CountContacts(work, size * chunk / kNumChunks, size * (chunk + 1) / kNumChunks,
                    contacts[chunk]);
    }
  });
  Contacts all;
  for (const Contacts& chunk : contacts) {
    for (std::size_t i = 0; i < chunk.counts.size(); ++i) {
      all.Add(chunk.pairs.keys()[i], chunk.counts[i]);
    }
  }
  edges.reserve(edges.size() + all.counts.size());
  for (std::size_t i = 0; i < all.counts.size(); ++i) {
    const std::uint64_t pair = all.pairs.keys()[i];
    edges.push_back(
        {static_cast<std::uint32_t>(pair >> 32), static_cast<std::uint32_t>(pair), all.counts[i]});
  }
  std::sort(edges.begin(), edges.end(), [](const PatchEdge& first, const PatchEdge& second) {
    return std::pair(first.a, first.b) < std::pair(second.a, second.b);
  });
}

void Complete(const Work& work, PatchGraph& graph) {
  MakePatches(work, graph.patches);
  FindEdges(work, graph.edges);
  MeasureAreas(work, graph.patches);
}

}  // namespace

PatchGraph BuildPatchGraph(const VoxelGrid& grid,
                           const std::vector<Eigen::Vector3f>& normals,
                           const Supervoxels& supervoxels,
                           int num_threads) {
  PatchGraph graph{std::vector<Patch>(supervoxels.num_patches), {}};
  std::vector<std::uint8_t> is_open(supervoxels.num_patches, 1);
  Complete({grid, normals, supervoxels, std::move(is_open), num_threads}, graph);
  return graph;
}

PatchGraph UpdatePatchGraph(const VoxelGrid& grid,
                            const std::vector<Eigen::Vector3f>& normals,
                            const Supervoxels& supervoxels,
                            const PatchGraph& old_graph,
                            const std::vector<std::uint32_t>& old_number,
                            int num_threads) {
  PatchGraph graph{std::vector<Patch>(supervoxels.num_patches), {}};
  std::vector<std::uint8_t> is_open(supervoxels.num_patches, 0);
  std::vector<std::uint32_t> new_number(old_graph.patches.size(), kNoPatch);
  for (std::uint32_t i = 0; i < supervoxels.num_patches; ++i) {
    if (old_number[i] == kNoPatch) {
      is_open[i] = 1;
    } else {
      graph.patches[i] = old_graph.patches[old_number[i]];
      new_number[old_number[i]] = i;
    }
  }
  for (const PatchEdge& edge : old_graph.edges) {
    const std::uint32_t a = new_number[edge.a];
    const std::uint32_t b = new_number[edge.b];
    if (a != kNoPatch && b != kNoPatch) graph.edges.push_back({a, b, edge.num_contacts});
  }
  Complete({grid, normals, supervoxels, std::move(is_open), num_threads}, graph);
  return graph;
}

}  // namespace semslam

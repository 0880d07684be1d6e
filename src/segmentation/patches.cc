// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/patches.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "semslam/base/key_numbers.h"
#include "semslam/base/large_vector.h"
#include "semslam/base/parallel.h"

#include "segmentation/voxel_groups.h"

namespace semslam {
namespace {

constexpr std::size_t kVoxelGrain = 8192;

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
  std::span<const std::uint32_t> patch_of_voxel;
  // By patch. Not of bool: it is read all the time.
  std::vector<std::uint8_t> is_open;
  bool all_open = false;
  VoxelGroups voxels;  // Of the open patches.
  int num_threads;
};

// The same labels, but kNoPatch where the patch is not open.
LargeVector<std::uint32_t> KeepOpen(std::span<const std::uint32_t> patch_of_voxel,
                                    const std::vector<std::uint8_t>& is_open,
                                    int num_threads) {
  LargeVector<std::uint32_t> kept(patch_of_voxel.size());
  ParallelFor(kept.size(), kVoxelGrain, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t voxel = first; voxel < last; ++voxel) {
      const std::uint32_t patch = patch_of_voxel[voxel];
      kept[voxel] = patch == kNoPatch || is_open[patch] == 0 ? kNoPatch : patch;
    }
  });
  return kept;
}

// Calls body(patch) for the open patches, side by side.
template <typename Body>
void ForOpenPatches(const Work& work, const Body& body) {
  constexpr std::size_t kGrain = 128;
  const auto body_if_open = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (work.is_open[i] != 0) body(i);
    }
  };
  ParallelFor(work.is_open.size(), kGrain, work.num_threads, body_if_open);
}

void MakePatch(const Work& work, std::span<const std::uint32_t> voxels, Patch& patch) {
  PatchSums sums;
  for (const std::uint32_t voxel : voxels) {
    const Eigen::Vector3d p = work.grid.centroids[voxel].cast<double>();
    sums.count += 1;
    sums.sum += p;
    sums.squares += p.cwiseProduct(p);
    sums.products += Eigen::Vector3d(p.y() * p.z(), p.z() * p.x(), p.x() * p.y());
    sums.normal += work.normals[voxel].cast<double>();
  }
  patch.moments = sums.ToMoments();
  patch.num_voxels = voxels.size();
  patch.centroid = patch.moments.Mean();
  patch.normal = sums.normal.normalized();  // Leaves a zero vector as it is.
  if (const std::optional<PlaneFit> fit = FitPlane(patch.moments)) {
    patch.variation = fit->variation;
  }
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
double MeasureArea(const Work& work, std::span<const std::uint32_t> voxels, const Patch& patch) {
  const Eigen::Vector3f normal = patch.normal.cast<float>();
  int axis = 0;
  const float cosine = normal.cwiseAbs().maxCoeff(&axis);
  const double face = work.grid.voxel_size * work.grid.voxel_size;
  double area = 0;
  for (const std::uint32_t voxel : voxels) {
    const int count = CountColumn(work.grid, work.normals, normal, voxel, axis);
    const float share = 1.0F / (static_cast<float>(count) * (cosine > 0 ? cosine : 1.0F));
    area += face * static_cast<double>(share);
  }
  return area;
}

// Contacts between patches, counted: the pairs (lower patch in the high bits) and how often each.
struct Contacts {
  KeyNumbers pairs{0};
  std::vector<std::uint32_t> counts;
  std::uint64_t last_pair = 0;  // Is none: the lower patch comes first.
  std::uint32_t last_number = 0;

  void Add(std::uint32_t a, std::uint32_t b) {
    Add(std::uint64_t{std::min(a, b)} << 32 | std::max(a, b), std::uint32_t{1});
  }
  void Add(std::uint64_t pair, std::uint32_t count) {
    if (pair != last_pair) {  // Mostly it is the same.
      last_pair = pair;
      last_number = pairs.Insert(pair);
      if (last_number == counts.size()) counts.push_back(0);
    }
    counts[last_number] += count;
  }
};

// If all patches are open: of each pair of voxels the higher looks at the lower.
void CountAllContacts(const Work& work, std::size_t first, std::size_t last, Contacts& contacts) {
  std::array<std::uint32_t, 27> found{};
  for (std::size_t voxel = first; voxel < last; ++voxel) {
    const std::uint32_t a = work.patch_of_voxel[voxel];
    if (a == kNoPatch) continue;
    std::size_t num_found = 0;
    for (const std::uint32_t other : work.grid.LowerNeighboursOf(voxel)) {
      const std::uint32_t b = work.patch_of_voxel[other];
      found[num_found] = b;  // Without a branch: nobody could predict it.
      num_found += b != a ? 1 : 0;
    }
    for (std::size_t i = 0; i < num_found; ++i) {
      if (found[i] != kNoPatch) contacts.Add(a, found[i]);
    }
  }
}

// Of open patches, among each other and with the others.
void CountContacts(const Work& work, std::size_t first, std::size_t last, Contacts& contacts) {
  for (std::size_t voxel = first; voxel < last; ++voxel) {
    const std::uint32_t a = work.patch_of_voxel[voxel];
    if (a == kNoPatch || work.is_open[a] == 0) continue;
    for (const std::uint32_t other : work.grid.NeighboursOf(voxel)) {
      const std::uint32_t b = work.patch_of_voxel[other];
      if (b == a || b == kNoPatch) continue;
      // Between open patches both directions of a pair of voxels are seen: that to the lower
      // counts.
      if (other < voxel || work.is_open[b] == 0) contacts.Add(a, b);
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
      const std::size_t first = size * chunk / kNumChunks;
      const std::size_t last = size * (chunk + 1) / kNumChunks;
      work.all_open ? CountAllContacts(work, first, last, contacts[chunk])
                    : CountContacts(work, first, last, contacts[chunk]);
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
  ForOpenPatches(work, [&](std::size_t i) {
    Patch& patch = graph.patches[i];
    MakePatch(work, work.voxels.Of(i), patch);
    patch.area = MeasureArea(work, work.voxels.Of(i), patch);
  });
  FindEdges(work, graph.edges);
}

}  // namespace

PatchGraph BuildPatchGraph(const VoxelGrid& grid,
                           const std::vector<Eigen::Vector3f>& normals,
                           const Supervoxels& supervoxels,
                           int num_threads) {
  const std::size_t num_patches = supervoxels.num_patches;
  PatchGraph graph{std::vector<Patch>(num_patches), {}};
  Complete({grid, normals, supervoxels.patch_of_voxel, std::vector<std::uint8_t>(num_patches, 1),
            true, GroupVoxels(supervoxels.patch_of_voxel, num_patches, num_threads), num_threads},
           graph);
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
  VoxelGroups voxels = GroupVoxels(KeepOpen(supervoxels.patch_of_voxel, is_open, num_threads),
                                   supervoxels.num_patches, num_threads);
  Complete({grid, normals, supervoxels.patch_of_voxel, std::move(is_open), false, std::move(voxels),
            num_threads},
           graph);
  return graph;
}

}  // namespace semslam

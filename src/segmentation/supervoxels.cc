// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/supervoxels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "semslam/base/parallel.h"

#include "segmentation/disjoint_sets.h"
#include "segmentation/seed_cells.h"

namespace semslam {
namespace {

constexpr std::size_t kGrain = 8192;

// What a patch is to the voxels around it.
struct Centre {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
};

// Distance of a voxel from a patch.
class PatchDistance {
 public:
  explicit PatchDistance(const SupervoxelOptions& options)
      : spatial_factor_(static_cast<float>(options.spatial_weight / options.seed_spacing)),
        normal_factor_(static_cast<float>(options.normal_weight)),
        offset_factor_(static_cast<float>(options.offset_weight / options.seed_spacing)),
        offset_tolerance_(static_cast<float>(options.offset_tolerance)) {}

  float operator()(const Centre& centre,
                   const Eigen::Vector3f& position,
                   const Eigen::Vector3f& normal) const {
    const Eigen::Vector3f away = position - centre.position;
    const float offset = std::max(std::abs(centre.normal.dot(away)) - offset_tolerance_, 0.0F);
    return spatial_factor_ * away.norm() + normal_factor_ * (1 - normal.dot(centre.normal)) +
           offset_factor_ * offset;
  }

 private:
  float spatial_factor_;
  float normal_factor_;
  float offset_factor_;
  float offset_tolerance_;
};

// Per occupied seed cell the voxel nearest to the mean of the cell's voxels.
std::vector<Centre> PlaceSeeds(const VoxelGrid& grid,
                               const std::vector<Eigen::Vector3f>& normals,
                               const SeedCells& cells) {
  struct Cell {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    float count = 0;
    std::uint32_t nearest = 0;
    float distance = std::numeric_limits<float>::max();
  };
  std::vector<Cell> found(cells.num_cells());
  for (std::size_t voxel = 0; voxel < grid.size(); ++voxel) {
    Cell& cell = found[cells.cell_of_voxel()[voxel]];
    cell.sum += grid.centroids[voxel];
    cell.count += 1;
  }
  for (Cell& cell : found) cell.sum /= cell.count;
  for (std::size_t voxel = 0; voxel < grid.size(); ++voxel) {
    Cell& cell = found[cells.cell_of_voxel()[voxel]];
    const float distance = (grid.centroids[voxel] - cell.sum).squaredNorm();
    if (distance >= cell.distance) continue;
    cell.distance = distance;
    cell.nearest = static_cast<std::uint32_t>(voxel);
  }
  std::vector<Centre> seeds;
  for (const Cell& cell : found) {
    seeds.push_back({grid.centroids[cell.nearest], normals[cell.nearest]});
  }
  return seeds;
}

// The nearest of the centres around each voxel.
std::vector<std::uint32_t> AssignVoxels(const VoxelGrid& grid,
                                        const std::vector<Eigen::Vector3f>& normals,
                                        const std::vector<Centre>& centres,
                                        const SeedCells& cells,
                                        const PatchDistance& distance_to,
                                        int num_threads) {
  std::vector<Eigen::Vector3f> positions;
  positions.reserve(centres.size());
  for (const Centre& centre : centres) positions.push_back(centre.position);
  const SeedCells::Lists near = cells.FindNear(positions);
  std::vector<std::uint32_t> nearest(grid.size(), kNoPatch);
  ParallelFor(grid.size(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t voxel = first; voxel < last; ++voxel) {
      float least = std::numeric_limits<float>::max();
      for (const std::uint32_t i : near.Of(cells.cell_of_voxel()[voxel])) {
        const float distance = distance_to(centres[i], grid.centroids[voxel], normals[voxel]);
        if (distance >= least) continue;
        least = distance;
        nearest[voxel] = i;
      }
    }
  });
  return nearest;
}

// The connected pieces of equal labels; of each voxel the first voxel of its piece.
std::vector<std::uint32_t> FindPieces(const VoxelGrid& grid,
                                      const std::vector<std::uint32_t>& labels) {
  DisjointSets sets(grid.size());
  for (std::uint32_t voxel = 0; voxel < grid.size(); ++voxel) {
    for (const std::uint32_t other : grid.NeighboursOf(voxel)) {
      if (other >= voxel) break;  // They ascend.
      if (labels[other] == labels[voxel]) sets.Join(voxel, other);
    }
  }
  std::vector<std::uint32_t> pieces(grid.size());
  for (std::uint32_t voxel = 0; voxel < grid.size(); ++voxel) pieces[voxel] = sets.Find(voxel);
  return pieces;
}

// Numbers the pieces that are large enough to be a patch, in the order of their first voxels.
Supervoxels NumberPieces(const std::vector<std::uint32_t>& pieces, std::size_t min_voxels) {
  std::vector<std::uint32_t> sizes(pieces.size(), 0);
  for (const std::uint32_t piece : pieces) ++sizes[piece];
  Supervoxels result;
  result.patch_of_voxel.resize(pieces.size());
  for (std::size_t voxel = 0; voxel < pieces.size(); ++voxel) {
    const std::uint32_t piece = pieces[voxel];
    std::uint32_t& patch = result.patch_of_voxel[voxel];
    if (sizes[piece] < min_voxels) {
      patch = kNoPatch;
    } else {
      patch = piece == voxel ? result.num_patches++ : result.patch_of_voxel[piece];
    }
  }
  return result;
}

std::vector<Centre> CentresOf(const VoxelGrid& grid,
                              const std::vector<Eigen::Vector3f>& normals,
                              const Supervoxels& supervoxels) {
  struct Sum {
    double count = 0;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  };
  std::vector<Sum> sums(supervoxels.num_patches);
  for (std::size_t voxel = 0; voxel < grid.size(); ++voxel) {
    if (supervoxels.patch_of_voxel[voxel] == kNoPatch) continue;
    Sum& sum = sums[supervoxels.patch_of_voxel[voxel]];
    sum.count += 1;
    sum.position += grid.centroids[voxel].cast<double>();
    sum.normal += normals[voxel];
  }
  std::vector<Centre> centres;
  for (const Sum& sum : sums) {
    // Leaves a zero normal as it is.
    centres.push_back({(sum.position / sum.count).cast<float>(), sum.normal.normalized()});
  }
  return centres;
}

// Voxels without a patch join the nearest of those they touch, round by round from outside.
void JoinCrumbs(const VoxelGrid& grid,
                const std::vector<Eigen::Vector3f>& normals,
                const std::vector<Centre>& centres,
                const PatchDistance& distance_to,
                Supervoxels& supervoxels) {
  std::vector<std::uint32_t>& patch_of_voxel = supervoxels.patch_of_voxel;
  std::vector<std::uint32_t> open;
  for (std::uint32_t voxel = 0; voxel < grid.size(); ++voxel) {
    if (patch_of_voxel[voxel] == kNoPatch) open.push_back(voxel);
  }
  std::vector<std::uint32_t> joined(open.size());
  for (std::size_t num_open = open.size() + 1; open.size() < num_open;) {
    num_open = open.size();
    for (std::size_t i = 0; i < num_open; ++i) {
      joined[i] = kNoPatch;
      float least = std::numeric_limits<float>::max();
      for (const std::uint32_t other : grid.NeighboursOf(open[i])) {
        const std::uint32_t patch = patch_of_voxel[other];
        if (patch == kNoPatch || patch == joined[i]) continue;
        const float distance =
            distance_to(centres[patch], grid.centroids[open[i]], normals[open[i]]);
        if (distance > least || (distance == least && patch > joined[i])) continue;
        least = distance;
        joined[i] = patch;
      }
    }
    for (std::size_t i = 0; i < num_open; ++i) patch_of_voxel[open[i]] = joined[i];
    std::erase_if(open, [&](std::uint32_t voxel) { return patch_of_voxel[voxel] != kNoPatch; });
  }
}

}  // namespace

Supervoxels GrowSupervoxels(const VoxelGrid& grid,
                            const std::vector<Eigen::Vector3f>& normals,
                            const SupervoxelOptions& options,
                            int num_threads) {
  const SeedCells cells(grid, options.seed_spacing);
  const PatchDistance distance_to(options);
  std::vector<Centre> centres = PlaceSeeds(grid, normals, cells);
  Supervoxels result;
  for (int pass = 0; pass < options.num_passes; ++pass) {
    const std::vector<std::uint32_t> labels =
        AssignVoxels(grid, normals, centres, cells, distance_to, num_threads);
    result = NumberPieces(FindPieces(grid, labels), options.min_voxels);
    centres = CentresOf(grid, normals, result);
  }
  JoinCrumbs(grid, normals, centres, distance_to, result);
  return result;
}

}  // namespace semslam

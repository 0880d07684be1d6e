// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/supervoxels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include "semslam/base/large_vector.h"
#include "semslam/base/parallel.h"

#include "segmentation/disjoint_sets.h"
#include "segmentation/lanes.h"
#include "segmentation/seed_cells.h"
#include "segmentation/voxel_groups.h"

namespace semslam {
namespace {

constexpr std::size_t kGrain = 8192;      // Voxels.
constexpr std::size_t kPatchGrain = 256;  // Patches or seed cells.

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

  // Of four patches.
  __m128 operator()(const FourPoints& centres,
                    const Eigen::Vector3f& position,
                    const Eigen::Vector3f& normal) const {
    const auto load = [](const std::array<float, 4>& row) { return _mm_load_ps(row.data()); };
    const __m128 x = _mm_sub_ps(_mm_set1_ps(position.x()), load(centres.x));
    const __m128 y = _mm_sub_ps(_mm_set1_ps(position.y()), load(centres.y));
    const __m128 z = _mm_sub_ps(_mm_set1_ps(position.z()), load(centres.z));
    const __m128 nx = load(centres.normal_x);
    const __m128 ny = load(centres.normal_y);
    const __m128 nz = load(centres.normal_z);
    const __m128 offset =
        _mm_max_ps(_mm_sub_ps(Absolute(Dot(x, y, z, nx, ny, nz)), _mm_set1_ps(offset_tolerance_)),
                   _mm_setzero_ps());
    const __m128 cosine =
        Dot(nx, ny, nz, _mm_set1_ps(normal.x()), _mm_set1_ps(normal.y()), _mm_set1_ps(normal.z()));
    const __m128 away = _mm_sqrt_ps(Dot(x, y, z, x, y, z));
    return _mm_add_ps(
        _mm_add_ps(_mm_mul_ps(_mm_set1_ps(spatial_factor_), away),
                   _mm_mul_ps(_mm_set1_ps(normal_factor_), _mm_sub_ps(_mm_set1_ps(1), cosine))),
        _mm_mul_ps(_mm_set1_ps(offset_factor_), offset));
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
                               const SeedCells& cells,
                               int num_threads) {
  const VoxelGroups voxels = GroupVoxels(cells.cell_of_voxel(), cells.num_cells(), num_threads);
  std::vector<Centre> seeds(cells.num_cells());
  ParallelFor(seeds.size(), kPatchGrain, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t cell = first; cell < last; ++cell) {
      const std::span<const std::uint32_t> members = voxels.Of(cell);
      Eigen::Vector3f mean = Eigen::Vector3f::Zero();
      for (const std::uint32_t voxel : members) mean += grid.centroids[voxel];
      mean /= static_cast<float>(members.size());
      std::uint32_t nearest = 0;
      float least = std::numeric_limits<float>::max();
      for (const std::uint32_t voxel : members) {
        const float distance = (grid.centroids[voxel] - mean).squaredNorm();
        if (distance >= least) continue;
        least = distance;
        nearest = voxel;
      }
      seeds[cell] = {grid.centroids[nearest], normals[nearest]};
    }
  });
  return seeds;
}

// The centres around a cell, four at a time; lanes without one are infinitely far.
struct CentreGroup {
  FourPoints points;
  alignas(16) std::array<std::uint32_t, 4> indices{};
};

std::vector<CentreGroup> GroupCentres(std::span<const std::uint32_t> indices,
                                      const std::vector<Centre>& centres) {
  constexpr float kNowhere = 1e15F;  // Its square is still a float.
  std::vector<CentreGroup> groups((indices.size() + 3) / 4);
  for (std::size_t i = 0; i < 4 * groups.size(); ++i) {
    CentreGroup& group = groups[i / 4];
    if (i < indices.size()) {
      group.points.Set(i % 4, centres[indices[i]].position, centres[indices[i]].normal);
      group.indices[i % 4] = indices[i];
    } else {
      group.points.Set(i % 4, Eigen::Vector3f::Constant(kNowhere), Eigen::Vector3f::Zero());
      group.indices[i % 4] = kNoPatch;
    }
  }
  return groups;
}

// The index of the lane with the least distance, of equal ones the least index.
std::uint32_t LeastLane(__m128 distances, __m128i indices) {
  __m128 least =
      _mm_min_ps(distances, _mm_shuffle_ps(distances, distances, _MM_SHUFFLE(1, 0, 3, 2)));
  least = _mm_min_ps(least, _mm_shuffle_ps(least, least, _MM_SHUFFLE(2, 3, 0, 1)));
  const __m128i is_least = _mm_castps_si128(_mm_cmpeq_ps(distances, least));
  // The others' indices become larger than any.
  __m128i rest = _mm_or_si128(_mm_and_si128(is_least, indices),
                              _mm_srli_epi32(_mm_andnot_si128(is_least, _mm_set1_epi32(-1)), 1));
  const auto lesser = [](__m128i x, __m128i y) {
    const __m128i is_less = _mm_cmplt_epi32(x, y);
    return _mm_or_si128(_mm_and_si128(is_less, x), _mm_andnot_si128(is_less, y));
  };
  rest = lesser(rest, _mm_shuffle_epi32(rest, _MM_SHUFFLE(1, 0, 3, 2)));
  rest = lesser(rest, _mm_shuffle_epi32(rest, _MM_SHUFFLE(2, 3, 0, 1)));
  return static_cast<std::uint32_t>(_mm_cvtsi128_si32(rest));
}

// Of equally near centres the first.
std::uint32_t NearestOf(std::span<const CentreGroup> groups,
                        const PatchDistance& distance_to,
                        const Eigen::Vector3f& position,
                        const Eigen::Vector3f& normal) {
  __m128 best = _mm_set1_ps(std::numeric_limits<float>::max());
  __m128 best_indices = _mm_castsi128_ps(_mm_set1_epi32(-1));
  for (const CentreGroup& group : groups) {
    const __m128 distance = distance_to(group.points, position, normal);
    const __m128 is_less = _mm_cmplt_ps(distance, best);
    best = _mm_min_ps(distance, best);
    const auto* words = reinterpret_cast<const float*>(group.indices.data());
    best_indices = Choose(is_less, _mm_load_ps(words), best_indices);
  }
  return LeastLane(best, _mm_castps_si128(best_indices));
}

// The nearest of the centres around each voxel.
LargeVector<std::uint32_t> AssignVoxels(const VoxelGrid& grid,
                                        const std::vector<Eigen::Vector3f>& normals,
                                        const std::vector<Centre>& centres,
                                        const SeedCells& cells,
                                        const PatchDistance& distance_to,
                                        int num_threads) {
  std::vector<Eigen::Vector3f> positions;
  positions.reserve(centres.size());
  for (const Centre& centre : centres) positions.push_back(centre.position);
  std::vector<std::vector<CentreGroup>> groups(cells.num_cells());
  cells.VisitNear(positions, num_threads,
                  [&](std::uint32_t cell, std::span<const std::uint32_t> near) {
                    groups[cell] = GroupCentres(near, centres);
                  });
  LargeVector<std::uint32_t> nearest(grid.size());
  ParallelFor(grid.size(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t voxel = first; voxel < last; ++voxel) {
      nearest[voxel] = NearestOf(groups[cells.cell_of_voxel()[voxel]], distance_to,
                                 grid.centroids[voxel], normals[voxel]);
    }
  });
  return nearest;
}

// Two adjacent voxels.
using Contact = std::pair<std::uint32_t, std::uint32_t>;

// Joins the voxels from `first` to `last` with their lower neighbours of the same label. Returns
// the contacts with such before `first`.
std::vector<Contact> JoinWithin(const VoxelGrid& grid,
                                const LargeVector<std::uint32_t>& labels,
                                std::uint32_t first,
                                std::uint32_t last,
                                DisjointSets& sets) {
  constexpr int kLeft = VoxelGrid::NeighbourBit(-1, 0, 0);
  // Of the lower neighbours those that are not neighbours of the left one too.
  constexpr std::uint32_t kBesidesLeft =
      1U << VoxelGrid::NeighbourBit(1, -1, -1) | 1U << VoxelGrid::NeighbourBit(1, 0, -1) |
      1U << VoxelGrid::NeighbourBit(1, 1, -1) | 1U << VoxelGrid::NeighbourBit(1, -1, 0);
  std::vector<Contact> seam;
  for (std::uint32_t voxel = first; voxel < last; ++voxel) {
    const std::uint32_t label = labels[voxel];
    std::uint32_t piece = voxel;
    const auto join = [&](std::uint32_t other) {
      if (labels[other] != label) return;
      if (other < first) {
        seam.emplace_back(voxel, other);
      } else if (!sets.IsKnownToBeOf(other, piece)) {
        const std::uint32_t of_other = sets.Find(other);
        if (of_other != piece) piece = sets.JoinRepresentatives(piece, of_other);
      }
    };
    std::uint32_t bits = grid.neighbour_bits[voxel];
    if (voxel > first && (bits >> kLeft & 1) != 0 && labels[voxel - 1] == label) {
      join(voxel - 1);
      for (bits &= kBesidesLeft; bits != 0; bits &= bits - 1) {
        join(grid.NeighbourAt(voxel, std::countr_zero(bits)));
      }
    } else {
      for (const std::uint32_t other : grid.LowerNeighboursOf(voxel)) join(other);
    }
  }
  return seam;
}

// The connected pieces of equal labels.
struct Pieces {
  DisjointSets sets;
  LargeVector<std::uint32_t> num_voxels;  // By the first voxel of a piece; of others zero.
};

Pieces FindPieces(const VoxelGrid& grid,
                  const LargeVector<std::uint32_t>& labels,
                  int num_threads) {
  constexpr std::size_t kNumChunks = 8;
  Pieces pieces = {DisjointSets(grid.size()), LargeVector<std::uint32_t>(grid.size(), 0)};
  DisjointSets& sets = pieces.sets;
  LargeVector<std::uint32_t>& num_voxels = pieces.num_voxels;
  // Within chunks side by side; then what connects them.
  std::vector<std::vector<Contact>> seams(kNumChunks);
  ParallelFor(kNumChunks, 1, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t chunk = begin; chunk < end; ++chunk) {
      const auto first = static_cast<std::uint32_t>(grid.size() * chunk / kNumChunks);
      const auto last = static_cast<std::uint32_t>(grid.size() * (chunk + 1) / kNumChunks);
      seams[chunk] = JoinWithin(grid, labels, first, last, sets);
      for (std::uint32_t voxel = first; voxel < last; ++voxel) ++num_voxels[sets.Find(voxel)];
    }
  });
  for (const std::vector<Contact>& seam : seams) {
    for (const auto& [voxel, other] : seam) {
      const std::uint32_t a = sets.Find(voxel);
      const std::uint32_t b = sets.Find(other);
      if (a == b) continue;
      const std::uint32_t sum = num_voxels[a] + num_voxels[b];
      num_voxels[a] = num_voxels[b] = 0;
      num_voxels[sets.JoinRepresentatives(a, b)] = sum;
    }
  }
  return pieces;
}

// Numbers the pieces that are large enough to be a patch, in the order of their first voxels.
Supervoxels NumberPieces(Pieces pieces, std::size_t min_voxels, int num_threads) {
  Supervoxels result;
  LargeVector<std::uint32_t>& numbers = pieces.num_voxels;
  for (std::uint32_t& number : numbers) {
    if (number != 0) number = number < min_voxels ? kNoPatch : result.num_patches++;
  }
  result.patch_of_voxel.resize(numbers.size());
  ParallelFor(numbers.size(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t voxel = first; voxel < last; ++voxel) {
      const std::uint32_t piece = pieces.sets.Representative(static_cast<std::uint32_t>(voxel));
      result.patch_of_voxel[voxel] = numbers[piece];
    }
  });
  return result;
}

std::vector<Centre> CentresOf(const VoxelGrid& grid,
                              const std::vector<Eigen::Vector3f>& normals,
                              const Supervoxels& supervoxels,
                              int num_threads) {
  const VoxelGroups voxels =
      GroupVoxels(supervoxels.patch_of_voxel, supervoxels.num_patches, num_threads);
  std::vector<Centre> centres(supervoxels.num_patches);
  ParallelFor(centres.size(), kPatchGrain, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t patch = first; patch < last; ++patch) {
      Eigen::Vector3d position = Eigen::Vector3d::Zero();
      Eigen::Vector3f normal = Eigen::Vector3f::Zero();
      for (const std::uint32_t voxel : voxels.Of(patch)) {
        position += grid.centroids[voxel].cast<double>();
        normal += normals[voxel];
      }
      const auto count = static_cast<double>(voxels.Of(patch).size());
      // Leaves a zero normal as it is.
      centres[patch] = {(position / count).cast<float>(), normal.normalized()};
    }
  });
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
  const SeedCells cells(grid, options.seed_spacing, num_threads);
  const PatchDistance distance_to(options);
  std::vector<Centre> centres = PlaceSeeds(grid, normals, cells, num_threads);
  Supervoxels result;
  for (int pass = 0; pass < options.num_passes; ++pass) {
    const LargeVector<std::uint32_t> labels =
        AssignVoxels(grid, normals, centres, cells, distance_to, num_threads);
    result = NumberPieces(FindPieces(grid, labels, num_threads), options.min_voxels, num_threads);
    centres = CentresOf(grid, normals, result, num_threads);
  }
  JoinCrumbs(grid, normals, centres, distance_to, result);
  return result;
}

}  // namespace semslam

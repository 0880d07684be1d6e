// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/voxel_grid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <utility>

#include <emmintrin.h>

#include "semslam/base/check.h"
#include "semslam/base/parallel.h"

#include "segmentation/radix_sort.h"

namespace semslam {
namespace {

constexpr std::size_t kGrain = 16384;
// Coordinates beyond this many voxels from zero would leave the 21 bits an axis has.
constexpr double kMaxVoxelsFromZero = (1 << 20) - 8;

bool IsUsable(const Eigen::Vector3f& point, double max_coordinate) {
  // False for NaN too.
  return std::abs(point.x()) <= max_coordinate && std::abs(point.y()) <= max_coordinate &&
         std::abs(point.z()) <= max_coordinate;
}

struct Bounds {
  Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::max());
  Eigen::Vector3f high = Eigen::Vector3f::Constant(std::numeric_limits<float>::lowest());
  std::size_t num_points = 0;
};

Bounds FindBounds(std::span<const Eigen::Vector3f> points, double max_coordinate) {
  Bounds bounds;
  for (const Eigen::Vector3f& point : points) {
    if (!IsUsable(point, max_coordinate)) continue;
    bounds.low = bounds.low.cwiseMin(point);
    bounds.high = bounds.high.cwiseMax(point);
    ++bounds.num_points;
  }
  return bounds;
}

// From points to positions in voxels from the corner of the free cell below the cloud.
class GridPosition {
 public:
  explicit GridPosition(const VoxelGrid& grid)
      : origin_(grid.origin), voxels_per_metre_(1 / grid.voxel_size) {}

  Eigen::Vector3d operator()(const Eigen::Vector3f& point) const {
    return (point.cast<double>() - origin_) * voxels_per_metre_ + Eigen::Vector3d::Ones();
  }

 private:
  Eigen::Vector3d origin_;
  double voxels_per_metre_;
};

VoxelKeyLayout MakeLayout(const VoxelGrid& grid, const Eigen::Vector3f& high) {
  const Eigen::Vector3d extent = GridPosition(grid)(high);
  std::array<int, 3> bits{};
  for (int axis = 0; axis < 3; ++axis) {
    bits[axis] = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(extent[axis]) + 2));
  }
  return {bits[0], bits[0] + bits[1], bits[0] + bits[1] + bits[2]};
}

// The usable points' items, made of key and index.
template <typename Item, typename MakeItem>
std::vector<Item> MakeItems(const PointCloudView& cloud,
                            const VoxelGrid& grid,
                            std::size_t num_usable,
                            int num_threads,
                            const MakeItem& make_item) {
  const double max_coordinate = kMaxVoxelsFromZero * grid.voxel_size;
  const bool all_usable = num_usable == cloud.points.size();
  const GridPosition position_of(grid);
  std::vector<Item> items(cloud.points.size());
  ParallelFor(items.size(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Eigen::Vector3f& point = cloud.points[i];
      if (!all_usable && !IsUsable(point, max_coordinate)) {
        items[i] = make_item(0, 0);  // No usable point has key 0: below them the cells are free.
        continue;
      }
      const Eigen::Vector3i cell = position_of(point).cast<std::int32_t>();
      items[i] = make_item(grid.layout.Key(cell), static_cast<std::uint32_t>(i));
    }
  });
  return items;
}

// The points voxel by voxel: those of grid.keys[v] are points[begin[v] .. begin[v + 1]).
struct PointsByVoxel {
  std::vector<std::uint32_t> points;
  std::vector<std::uint32_t> begin;

  std::span<const std::uint32_t> Of(std::size_t voxel) const {
    return std::span(points).subspan(begin[voxel], begin[voxel + 1] - begin[voxel]);
  }
};

// Also finds the grid's keys. `num_unusable` items come first in the order of keys.
template <typename Item, typename KeyOf, typename IndexOf>
PointsByVoxel Divide(const std::vector<Item>& items,
                     std::size_t num_unusable,
                     const KeyOf& key_of,
                     const IndexOf& index_of,
                     VoxelGrid& grid) {
  PointsByVoxel result;
  result.points.reserve(items.size() - num_unusable);
  std::uint64_t last_key = 0;
  for (std::size_t i = num_unusable; i < items.size(); ++i) {
    const std::uint64_t key = key_of(items[i]);
    if (key != last_key) {
      result.begin.push_back(static_cast<std::uint32_t>(result.points.size()));
      grid.keys.push_back(key);
      last_key = key;
    }
    result.points.push_back(index_of(items[i]));
  }
  result.begin.push_back(static_cast<std::uint32_t>(result.points.size()));
  return result;
}

PointsByVoxel SortPoints(const PointCloudView& cloud,
                         std::size_t num_usable,
                         int num_threads,
                         VoxelGrid& grid) {
  const std::size_t num_unusable = cloud.points.size() - num_usable;
  const auto index_bits = static_cast<int>(std::bit_width(cloud.points.size()));
  if (grid.layout.num_bits + index_bits <= 64) {  // All but huge scenes: half the memory to sort.
    auto items = MakeItems<std::uint64_t>(
        cloud, grid, num_usable, num_threads,
        [&](std::uint64_t key, std::uint32_t index) { return key << index_bits | index; });
    RadixSort(items, index_bits, grid.layout.num_bits, num_threads);
    const std::uint64_t mask = (std::uint64_t{1} << index_bits) - 1;
    return Divide(
        items, num_unusable, [&](std::uint64_t item) { return item >> index_bits; },
        [&](std::uint64_t item) { return static_cast<std::uint32_t>(item & mask); }, grid);
  }
  auto items = MakeItems<KeyedIndex>(cloud, grid, num_usable, num_threads,
                                     [](std::uint64_t key, std::uint32_t index) {
                                       return KeyedIndex{key, index};
                                     });
  RadixSort(items, grid.layout.num_bits, num_threads);
  return Divide(
      items, num_unusable, [](const KeyedIndex& item) { return item.key; },
      [](const KeyedIndex& item) { return item.index; }, grid);
}

// Three numbers, and one more that has no meaning.
struct Sums {
  __m128d xy = _mm_setzero_pd();
  __m128d z = _mm_setzero_pd();

  // Adds whole numbers: exactly, so that their order has no effect.
  void Add(__m128i whole_xy, __m128i whole_z) {
    xy = _mm_add_pd(xy, _mm_cvtepi32_pd(whole_xy));
    z = _mm_add_pd(z, _mm_cvtepi32_pd(whole_z));
  }
  Eigen::Vector3d ToVector() const {
    return {_mm_cvtsd_f64(xy), _mm_cvtsd_f64(_mm_unpackhi_pd(xy, xy)), _mm_cvtsd_f64(z)};
  }
};

// Mean position and side of the points of one voxel.
void Accumulate(const PointCloudView& cloud,
                const GridPosition& position_of,
                std::span<const std::uint32_t> members,
                std::size_t voxel,
                VoxelGrid& grid) {
  constexpr double kPositionScale = 1 << 20;
  constexpr float kNormalScale = 1 << 20;
  const Eigen::Vector3d corner = grid.CellOf(voxel).cast<double>();
  Sums position;
  Sums view;
  for (const std::uint32_t index : members) {
    const Eigen::Vector3d offset = (position_of(cloud.points[index]) - corner) * kPositionScale;
    position.Add(_mm_cvttpd_epi32(_mm_setr_pd(offset.x(), offset.y())),
                 _mm_cvttpd_epi32(_mm_set_sd(offset.z())));
    if (cloud.normals.empty()) continue;
    const Eigen::Vector3f& normal = cloud.normals[index];
    const float norm = normal.norm();
    if (norm > 0 && std::isfinite(norm)) {
      const __m128i whole = _mm_cvttps_epi32(_mm_mul_ps(
          _mm_setr_ps(normal.x(), normal.y(), normal.z(), 0), _mm_set1_ps(kNormalScale / norm)));
      view.Add(whole, _mm_unpackhi_epi64(whole, whole));
    }
  }
  const double count = static_cast<double>(members.size());
  const Eigen::Vector3d mean = corner + position.ToVector() / (count * kPositionScale);
  grid.centroids[voxel] = ((mean - Eigen::Vector3d::Ones()) * grid.voxel_size).cast<float>();
  grid.views[voxel] = view.ToVector().cast<float>() / (kNormalScale * static_cast<float>(count));
}

// Points of a voxel lie anywhere in the cloud: memory is asked for them ahead of time.
void Prefetch(const PointCloudView& cloud, std::span<const std::uint32_t> members) {
  for (const std::uint32_t index : members) {
    __builtin_prefetch(&cloud.points[index]);
    if (!cloud.normals.empty()) __builtin_prefetch(&cloud.normals[index]);
  }
}

void FillVoxels(const PointCloudView& cloud,
                const PointsByVoxel& points,
                int num_threads,
                VoxelGrid& grid) {
  grid.centroids.resize(grid.keys.size());
  grid.views.resize(grid.keys.size());
  constexpr std::size_t kVoxelsAhead = 4;
  const GridPosition position_of(grid);
  ParallelFor(grid.size(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t voxel = first; voxel < last; ++voxel) {
      const auto members = points.Of(voxel);
      Prefetch(cloud, points.Of(std::min(voxel + kVoxelsAhead, last - 1)));
      Accumulate(cloud, position_of, members, voxel, grid);
      for (const std::uint32_t index : members) {
        grid.voxel_of_point[index] = static_cast<std::uint32_t>(voxel);
      }
    }
  });
}

// Walks the nine rows of three cells around each voxel along with it: the keys ascend, so that nine
// places in the sorted array only ever move up.
class NeighbourWalk {
 public:
  NeighbourWalk(const std::vector<std::uint64_t>& keys,
                const VoxelKeyLayout& layout,
                std::size_t first)
      : keys_(keys) {
    std::size_t row = 0;
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        // Two's complement makes the sum right for negative steps too.
        offsets_[row] =
            static_cast<std::uint64_t>(std::int64_t{dz} * (std::int64_t{1} << layout.shift_z) +
                                       std::int64_t{dy} * (std::int64_t{1} << layout.shift_y) - 1);
        places_[row] = static_cast<std::size_t>(
            std::lower_bound(keys.begin(), keys.end(), keys[first] + offsets_[row]) - keys.begin());
        ++row;
      }
    }
  }

  // Appends the neighbours in ascending order and returns their bits; voxels must come in ascending
  // order too.
  std::uint32_t Collect(std::size_t voxel, std::vector<std::uint32_t>& neighbours) {
    std::uint32_t bits = 0;
    std::array<std::uint32_t, 29> found;  // NOLINT: written before it is read.
    std::size_t num_found = 0;
    for (std::size_t row = 0; row < offsets_.size(); ++row) {
      const std::uint64_t low = keys_[voxel] + offsets_[row];
      std::size_t place = places_[row];
      while (keys_[place] < low) ++place;
      places_[row] = place;
      for (std::size_t i = 0; i < 3; ++i) {  // Without branches: nobody could predict them.
        const std::uint64_t step = keys_[place + i] - low;
        const std::uint32_t is_near = step <= 2 ? 1 : 0;
        bits |= is_near << (3 * row + (step & 3));
        found[num_found] = static_cast<std::uint32_t>(place + i);
        num_found += is_near & (place + i != voxel ? 1U : 0U);
      }
    }
    neighbours.insert(neighbours.end(), found.begin(), found.begin() + num_found);
    return bits;
  }

 private:
  const std::vector<std::uint64_t>& keys_;
  std::array<std::uint64_t, 9> offsets_{};
  std::array<std::size_t, 9> places_{};
};

void FindNeighbours(int num_threads, VoxelGrid& grid) {
  constexpr std::size_t kSize = VoxelNeighbours::kChunkSize;
  constexpr std::size_t kUsualNeighbours = 16;
  std::vector<VoxelNeighbours::Chunk> chunks((grid.size() + kSize - 1) / kSize);
  grid.neighbour_bits.resize(grid.size());
  // So that three keys may be looked at from any place on. None is near a voxel.
  grid.keys.insert(grid.keys.end(), 3, std::numeric_limits<std::uint64_t>::max());
  ParallelFor(chunks.size(), 1, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      VoxelNeighbours::Chunk& chunk = chunks[i];
      const std::size_t first = i * kSize;
      const std::size_t last = std::min(first + kSize, grid.size());
      chunk.begin.reserve(last - first + 1);
      chunk.indices.reserve(kUsualNeighbours * (last - first));
      NeighbourWalk walk(grid.keys, grid.layout, first);
      for (std::size_t voxel = first; voxel < last; ++voxel) {
        grid.neighbour_bits[voxel] = walk.Collect(voxel, chunk.indices);
        chunk.begin.push_back(static_cast<std::uint32_t>(chunk.indices.size()));
      }
    }
  });
  grid.keys.resize(grid.size());
  grid.neighbours = VoxelNeighbours(std::move(chunks));
}

}  // namespace

VoxelGrid BuildVoxelGrid(const PointCloudView& cloud, double voxel_size, int num_threads) {
  // Up to 26 neighbours a voxel are counted in 32 bits.
  SEMSLAM_CHECK(cloud.points.size() < (std::size_t{1} << 27)) << cloud.points.size() << " points";
  SEMSLAM_CHECK(cloud.normals.empty() || cloud.normals.size() == cloud.points.size())
      << cloud.points.size() << " points, " << cloud.normals.size() << " normals";
  VoxelGrid grid;
  grid.voxel_size = voxel_size;
  grid.voxel_of_point.assign(cloud.points.size(), kNoVoxel);
  const Bounds bounds = FindBounds(cloud.points, kMaxVoxelsFromZero * voxel_size);
  if (bounds.num_points == 0) return grid;

  grid.origin = bounds.low.cast<double>();
  grid.layout = MakeLayout(grid, bounds.high);
  FillVoxels(cloud, SortPoints(cloud, bounds.num_points, num_threads, grid), num_threads, grid);
  FindNeighbours(num_threads, grid);
  return grid;
}

VoxelGrid BuildConnectedVoxelGrid(const PointCloudView& cloud,
                                  double voxel_size,
                                  double max_growth,
                                  int num_threads) {
  // A closed surface has eight neighbours a voxel and more; stripes and crumbs have fewer. One step
  // more than that asks for closes the last seams between stripes.
  constexpr double kMinNeighbours = 6.5;
  constexpr double kStep = 1.25;
  VoxelGrid grid = BuildVoxelGrid(cloud, voxel_size, num_threads);
  const auto is_sparse = [&] {
    return static_cast<double>(grid.neighbours.size()) <
           kMinNeighbours * static_cast<double>(grid.size());
  };
  bool was_sparse = is_sparse();
  for (double growth = kStep; growth <= max_growth && was_sparse; growth *= kStep) {
    was_sparse = is_sparse();
    grid = BuildVoxelGrid(cloud, voxel_size * growth, num_threads);
  }
  return grid;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/voxel_grid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include <emmintrin.h>

#include "semslam/base/check.h"
#include "semslam/base/parallel.h"

#include "segmentation/radix_sort.h"
#include "segmentation/voxel_neighbours.h"

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

Bounds FindBounds(std::span<const Eigen::Vector3f> points, double max_coordinate, int num_threads) {
  const std::size_t num_chunks = points.size() / kGrain + 1;
  std::vector<Bounds> of_chunks(num_chunks);
  ParallelFor(num_chunks, 1, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t chunk = begin; chunk < end; ++chunk) {
      const std::size_t first = points.size() * chunk / num_chunks;
      const std::size_t last = points.size() * (chunk + 1) / num_chunks;
      of_chunks[chunk] = FindBounds(points.subspan(first, last - first), max_coordinate);
    }
  });
  Bounds bounds;
  for (const Bounds& chunk : of_chunks) {
    bounds.low = bounds.low.cwiseMin(chunk.low);
    bounds.high = bounds.high.cwiseMax(chunk.high);
    bounds.num_points += chunk.num_points;
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

// A point as it is sorted: the key of its voxel, then its index, in one number.
struct PackedItems {
  using Item = std::uint64_t;
  int index_bits = 0;

  Item Make(std::uint64_t key, std::uint32_t index) const { return key << index_bits | index; }
  std::uint64_t KeyOf(Item item) const { return item >> index_bits; }
  std::uint32_t IndexOf(Item item) const {
    return static_cast<std::uint32_t>(item & ((std::uint64_t{1} << index_bits) - 1));
  }
  void Sort(LargeVector<Item>& items, int num_bits, int num_threads) const {
    RadixSort(items, index_bits, num_bits, num_threads);
  }
};

// The same for huge scenes, whose keys leave no room for an index.
struct WideItems {
  using Item = KeyedIndex;

  static Item Make(std::uint64_t key, std::uint32_t index) { return {key, index}; }
  static std::uint64_t KeyOf(const Item& item) { return item.key; }
  static std::uint32_t IndexOf(const Item& item) { return item.index; }
  static void Sort(LargeVector<Item>& items, int num_bits, int num_threads) {
    RadixSort(items, num_bits, num_threads);
  }
};

// Of all points, in order; those that are not usable have key 0, as no other: below the cloud the
// cells are free.
template <typename Form>
LargeVector<typename Form::Item> MakeItems(const PointCloudView& cloud,
                                           const VoxelGrid& grid,
                                           bool all_usable,
                                           int num_threads,
                                           const Form& form) {
  const double max_coordinate = kMaxVoxelsFromZero * grid.voxel_size;
  const GridPosition position_of(grid);
  LargeVector<typename Form::Item> items(cloud.points.size());
  ParallelFor(items.size(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Eigen::Vector3f& point = cloud.points[i];
      if (!all_usable && !IsUsable(point, max_coordinate)) {
        items[i] = form.Make(0, 0);
        continue;
      }
      const Eigen::Vector3i cell = position_of(point).template cast<std::int32_t>();
      items[i] = form.Make(grid.layout.Key(cell), static_cast<std::uint32_t>(i));
    }
  });
  return items;
}

// Finds the grid's keys from the sorted items, and where those of each voxel begin, one more for
// the end. `num_unusable` come first.
template <typename Form>
LargeVector<std::uint32_t> Divide(const LargeVector<typename Form::Item>& items,
                                  std::size_t num_unusable,
                                  int num_threads,
                                  const Form& form,
                                  VoxelGrid& grid) {
  const std::size_t size = items.size() - num_unusable;
  const std::size_t num_chunks = size / kGrain + 1;
  // Calls body(item) for the first item of every voxel in a chunk.
  const auto for_voxels = [&](std::size_t chunk, const auto& body) {
    const std::size_t first = num_unusable + size * chunk / num_chunks;
    const std::size_t last = num_unusable + size * (chunk + 1) / num_chunks;
    std::uint64_t last_key = first == num_unusable ? 0 : form.KeyOf(items[first - 1]);
    for (std::size_t i = first; i < last; ++i) {
      const std::uint64_t key = form.KeyOf(items[i]);
      if (key != last_key) body(i);
      last_key = key;
    }
  };
  std::vector<std::size_t> begin_of_chunk(num_chunks + 1, 0);
  const auto for_chunks = [&](const auto& body) {
    ParallelFor(num_chunks, 1, num_threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t chunk = begin; chunk < end; ++chunk) body(chunk);
    });
  };
  for_chunks([&](std::size_t chunk) {
    std::size_t count = 0;
    for_voxels(chunk, [&](std::size_t /*item*/) { ++count; });
    begin_of_chunk[chunk + 1] = count;
  });
  std::partial_sum(begin_of_chunk.begin(), begin_of_chunk.end(), begin_of_chunk.begin());
  grid.keys.reserve(begin_of_chunk.back() + kNumKeysBeyond);
  grid.keys.resize(begin_of_chunk.back());
  LargeVector<std::uint32_t> begin(grid.keys.size() + 1);
  for_chunks([&](std::size_t chunk) {
    std::size_t voxel = begin_of_chunk[chunk];
    for_voxels(chunk, [&](std::size_t item) {
      grid.keys[voxel] = form.KeyOf(items[item]);
      begin[voxel++] = static_cast<std::uint32_t>(item);
    });
  });
  begin.back() = static_cast<std::uint32_t>(items.size());
  return begin;
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
template <typename Form>
void Accumulate(const PointCloudView& cloud,
                const GridPosition& position_of,
                std::span<const typename Form::Item> members,
                const Form& form,
                std::size_t voxel,
                VoxelGrid& grid) {
  constexpr double kPositionScale = 1 << 20;
  constexpr float kNormalScale = 1 << 20;
  const Eigen::Vector3d corner = grid.CellOf(voxel).cast<double>();
  Sums position;
  Sums view;
  for (const auto& member : members) {
    const std::uint32_t index = form.IndexOf(member);
    grid.voxel_of_point[index] = static_cast<std::uint32_t>(voxel);
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

// Sorts the points by their voxels, and fills those.
template <typename Form>
void FillVoxels(const PointCloudView& cloud,
                std::size_t num_usable,
                int num_threads,
                const Form& form,
                VoxelGrid& grid) {
  const std::size_t num_unusable = cloud.points.size() - num_usable;
  auto items = MakeItems(cloud, grid, num_unusable == 0, num_threads, form);
  form.Sort(items, grid.layout.num_bits, num_threads);
  const LargeVector<std::uint32_t> begin = Divide(items, num_unusable, num_threads, form, grid);
  grid.voxel_of_point.resize(cloud.points.size());
  if (num_unusable > 0) std::ranges::fill(grid.voxel_of_point, kNoVoxel);
  grid.centroids.resize(grid.keys.size());
  grid.views.resize(grid.keys.size());
  const GridPosition position_of(grid);
  ParallelFor(grid.size(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    // Points of a voxel lie anywhere in the cloud: memory is asked for them ahead of time.
    constexpr std::size_t kItemsAhead = 16;
    std::size_t ahead = begin[first];
    for (std::size_t voxel = first; voxel < last; ++voxel) {
      const auto members = std::span(items).subspan(begin[voxel], begin[voxel + 1] - begin[voxel]);
      const std::size_t end = std::min<std::size_t>(begin[voxel + 1] + kItemsAhead, begin[last]);
      for (; ahead < end; ++ahead) {
        const std::uint32_t index = form.IndexOf(items[ahead]);
        __builtin_prefetch(&cloud.points[index]);
        if (!cloud.normals.empty()) __builtin_prefetch(&cloud.normals[index]);
        __builtin_prefetch(&grid.voxel_of_point[index], 1);
      }
      Accumulate<Form>(cloud, position_of, members, form, voxel, grid);
    }
  });
}

}  // namespace

VoxelGrid BuildVoxelGrid(const PointCloudView& cloud, double voxel_size, int num_threads) {
  // Up to 26 neighbours a voxel are counted in 32 bits.
  SEMSLAM_CHECK(cloud.points.size() < (std::size_t{1} << 27)) << cloud.points.size() << " points";
  SEMSLAM_CHECK(cloud.normals.empty() || cloud.normals.size() == cloud.points.size())
      << cloud.points.size() << " points, " << cloud.normals.size() << " normals";
  VoxelGrid grid;
  grid.voxel_size = voxel_size;
  const Bounds bounds = FindBounds(cloud.points, kMaxVoxelsFromZero * voxel_size, num_threads);
  if (bounds.num_points == 0) {
    grid.voxel_of_point.assign(cloud.points.size(), kNoVoxel);
    return grid;
  }

  grid.origin = bounds.low.cast<double>();
  grid.layout = MakeLayout(grid, bounds.high);
  const auto index_bits = static_cast<int>(std::bit_width(cloud.points.size()));
  if (grid.layout.num_bits + index_bits <= 64) {
    FillVoxels(cloud, bounds.num_points, num_threads, PackedItems{index_bits}, grid);
  } else {
    FillVoxels(cloud, bounds.num_points, num_threads, WideItems(), grid);
  }
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

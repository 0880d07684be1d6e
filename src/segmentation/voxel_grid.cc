// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/voxel_grid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "semslam/base/check.h"
#include "semslam/base/parallel.h"

#include "segmentation/radix_sort.h"

namespace semslam {
namespace {

constexpr std::size_t kGrain = 16384;
// Coordinates beyond this many voxels from zero would leave the 21 bits an axis has.
constexpr double kMaxVoxelsFromZero = (1 << 20) - 8;

using Cell = Eigen::Matrix<std::int32_t, 3, 1>;

// Where the fields of a key begin. One free cell on either side of the cloud keeps the keys of
// neighbours apart from those of other rows.
struct KeyLayout {
  int shift_y = 0;
  int shift_z = 0;
  int num_bits = 0;

  std::uint64_t Key(const Cell& cell) const {
    return static_cast<std::uint64_t>(cell.z()) << shift_z |
           static_cast<std::uint64_t>(cell.y()) << shift_y | static_cast<std::uint64_t>(cell.x());
  }
  Cell CellOf(std::uint64_t key) const {
    return {
        static_cast<std::int32_t>(key & ((std::uint64_t{1} << shift_y) - 1)),
        static_cast<std::int32_t>(key >> shift_y & ((std::uint64_t{1} << (shift_z - shift_y)) - 1)),
        static_cast<std::int32_t>(key >> shift_z)};
  }
};

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

KeyLayout MakeLayout(const VoxelGrid& grid, const Eigen::Vector3f& high) {
  const Eigen::Vector3d extent = GridPosition(grid)(high);
  std::array<int, 3> bits{};
  for (int axis = 0; axis < 3; ++axis) {
    bits[axis] = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(extent[axis]) + 2));
  }
  return {bits[0], bits[0] + bits[1], bits[0] + bits[1] + bits[2]};
}

std::vector<KeyedIndex> SortedKeys(const PointCloudView& cloud,
                                   const VoxelGrid& grid,
                                   const KeyLayout& layout,
                                   std::size_t num_usable,
                                   int num_threads) {
  const double max_coordinate = kMaxVoxelsFromZero * grid.voxel_size;
  const bool all_usable = num_usable == cloud.points.size();
  const GridPosition position_of(grid);
  std::vector<KeyedIndex> items(cloud.points.size());
  ParallelFor(items.size(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Eigen::Vector3f& point = cloud.points[i];
      if (!all_usable && !IsUsable(point, max_coordinate)) continue;
      const Cell cell = position_of(point).cast<std::int32_t>();
      items[i] = {layout.Key(cell), static_cast<std::uint32_t>(i)};
    }
  });
  if (!all_usable) {
    // No usable point has key 0: all cells lie above the free ones.
    std::erase_if(items, [](const KeyedIndex& item) { return item.key == 0; });
  }
  RadixSort(items, layout.num_bits, num_threads);
  return items;
}

// Mean position and side of the points of one voxel. The sums are of integers, so that their order
// has no effect.
void Accumulate(const PointCloudView& cloud,
                const GridPosition& position_of,
                std::span<const KeyedIndex> items,
                std::size_t voxel,
                VoxelGrid& grid) {
  constexpr double kPositionScale = 1 << 20;
  constexpr float kNormalScale = 1 << 20;
  using Sum = Eigen::Matrix<std::int64_t, 3, 1>;
  const Eigen::Vector3d corner = grid.cells[voxel].cast<double>();
  Sum position = Sum::Zero();
  Sum view = Sum::Zero();
  for (const KeyedIndex& item : items) {
    const Eigen::Vector3d offset = position_of(cloud.points[item.index]) - corner;
    position += (offset * kPositionScale).cast<std::int64_t>();
    if (cloud.normals.empty()) continue;
    const Eigen::Vector3f& normal = cloud.normals[item.index];
    const float norm = normal.norm();
    if (norm > 0 && std::isfinite(norm)) {
      view += (normal * (kNormalScale / norm)).cast<std::int32_t>().cast<std::int64_t>();
    }
  }
  const double count = static_cast<double>(items.size());
  const Eigen::Vector3d mean = corner + position.cast<double>() / (count * kPositionScale);
  grid.centroids[voxel] = ((mean - Eigen::Vector3d::Ones()) * grid.voxel_size).cast<float>();
  grid.views[voxel] = view.cast<float>() / (kNormalScale * static_cast<float>(count));
}

void FillVoxels(const PointCloudView& cloud,
                const std::vector<KeyedIndex>& items,
                const KeyLayout& layout,
                int num_threads,
                VoxelGrid& grid) {
  std::vector<std::uint32_t> begin;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0 && items[i].key == items[i - 1].key) continue;
    begin.push_back(static_cast<std::uint32_t>(i));
    grid.keys.push_back(items[i].key);
  }
  begin.push_back(static_cast<std::uint32_t>(items.size()));
  grid.cells.resize(grid.size());
  grid.centroids.resize(grid.size());
  grid.views.resize(grid.size());
  const GridPosition position_of(grid);
  ParallelFor(grid.size(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t voxel = first; voxel < last; ++voxel) {
      const auto members = std::span(items).subspan(begin[voxel], begin[voxel + 1] - begin[voxel]);
      grid.cells[voxel] = layout.CellOf(grid.keys[voxel]);
      Accumulate(cloud, position_of, members, voxel, grid);
      for (const KeyedIndex& item : members) {
        grid.voxel_of_point[item.index] = static_cast<std::uint32_t>(voxel);
      }
    }
  });
}

// Walks the nine rows of three cells around each voxel along with it: the keys ascend, so that nine
// places in the sorted array only ever move up.
class NeighbourWalk {
 public:
  NeighbourWalk(const std::vector<std::uint64_t>& keys, const KeyLayout& layout, std::size_t first)
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
    for (std::size_t row = 0; row < offsets_.size(); ++row) {
      const std::uint64_t low = keys_[voxel] + offsets_[row];
      std::size_t& place = places_[row];
      while (place < keys_.size() && keys_[place] < low) ++place;
      for (std::size_t i = place; i < keys_.size() && keys_[i] <= low + 2; ++i) {
        bits |= std::uint32_t{1} << (3 * row + (keys_[i] - low));
        if (i != voxel) neighbours.push_back(static_cast<std::uint32_t>(i));
      }
    }
    return bits;
  }

 private:
  const std::vector<std::uint64_t>& keys_;
  std::array<std::uint64_t, 9> offsets_{};
  std::array<std::size_t, 9> places_{};
};

void FindNeighbours(const KeyLayout& layout, int num_threads, VoxelGrid& grid) {
  const std::size_t num_chunks = (grid.size() + kGrain - 1) / kGrain;
  std::vector<std::vector<std::uint32_t>> found(num_chunks);
  grid.neighbour_bits.resize(grid.size());
  const auto last_of = [&](std::size_t chunk) {
    return std::min((chunk + 1) * kGrain, grid.size());
  };
  ParallelFor(num_chunks, 1, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t chunk = begin; chunk < end; ++chunk) {
      constexpr std::size_t kUsualNeighbours = 12;
      found[chunk].reserve(kUsualNeighbours * kGrain);
      NeighbourWalk walk(grid.keys, layout, chunk * kGrain);
      for (std::size_t voxel = chunk * kGrain; voxel < last_of(chunk); ++voxel) {
        grid.neighbour_bits[voxel] = walk.Collect(voxel, found[chunk]);
      }
    }
  });
  grid.neighbour_begin.assign(grid.size() + 1, 0);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const auto count = static_cast<std::uint32_t>(std::popcount(grid.neighbour_bits[i])) - 1;
    grid.neighbour_begin[i + 1] = grid.neighbour_begin[i] + count;
  }
  grid.neighbours.resize(grid.neighbour_begin.back());
  ParallelFor(num_chunks, 1, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t chunk = begin; chunk < end; ++chunk) {
      std::copy(found[chunk].begin(), found[chunk].end(),
                grid.neighbours.begin() + grid.neighbour_begin[chunk * kGrain]);
      found[chunk] = {};
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
  grid.voxel_of_point.assign(cloud.points.size(), kNoVoxel);
  grid.neighbour_begin.assign(1, 0);
  const Bounds bounds = FindBounds(cloud.points, kMaxVoxelsFromZero * voxel_size);
  if (bounds.num_points == 0) return grid;

  grid.origin = bounds.low.cast<double>();
  const KeyLayout layout = MakeLayout(grid, bounds.high);
  const std::vector<KeyedIndex> items =
      SortedKeys(cloud, grid, layout, bounds.num_points, num_threads);
  FillVoxels(cloud, items, layout, num_threads, grid);
  FindNeighbours(layout, num_threads, grid);
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

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/voxel_normals.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <emmintrin.h>

#include "semslam/base/large_vector.h"
#include "semslam/base/parallel.h"

#include "segmentation/lanes.h"

namespace semslam {
namespace {

constexpr std::size_t kGrain = 8192;

// Moments of points about a place, in voxels: four lanes at a time (SSE2). The last lane counts the
// points in `sum` and means nothing in the others.
struct Moments {
  __m128 sum;       // x, y, z, count.
  __m128 squares;   // xx, yy, zz.
  __m128 products;  // yz, zx, xy.

  // Of one point in the place itself.
  static Moments OfPlace() { return {_mm_setr_ps(0, 0, 0, 1), _mm_setzero_ps(), _mm_setzero_ps()}; }

  // Adds a point that lies off the place by `offset`, whose last lane is zero.
  void Add(__m128 offset) {
    sum = _mm_add_ps(sum, _mm_add_ps(offset, _mm_setr_ps(0, 0, 0, 1)));
    squares = _mm_add_ps(squares, _mm_mul_ps(offset, offset));
    products = _mm_add_ps(products, _mm_mul_ps(Yzx(offset), Zxy(offset)));
  }

  // Adds the moments of other points about a place that lies off by `offset`.
  void Add(const Moments& other, __m128 offset) {
    const __m128 count = _mm_shuffle_ps(other.sum, other.sum, _MM_SHUFFLE(3, 3, 3, 3));
    const __m128 shift = _mm_mul_ps(count, offset);
    const __m128 sum_here = _mm_add_ps(other.sum, shift);
    sum = _mm_add_ps(sum, sum_here);
    // (p + o)(p + o)' summed is pp' + p o' + o (p + o)'.
    squares = _mm_add_ps(
        squares, _mm_add_ps(other.squares, _mm_mul_ps(offset, _mm_add_ps(other.sum, sum_here))));
    products = _mm_add_ps(
        products, _mm_add_ps(other.products, _mm_add_ps(_mm_mul_ps(Yzx(other.sum), Zxy(offset)),
                                                        _mm_mul_ps(Yzx(offset), Zxy(sum_here)))));
  }

 private:
  static __m128 Yzx(__m128 v) { return _mm_shuffle_ps(v, v, _MM_SHUFFLE(3, 0, 2, 1)); }
  static __m128 Zxy(__m128 v) { return _mm_shuffle_ps(v, v, _MM_SHUFFLE(3, 1, 0, 2)); }
};

// From one voxel's centroid to another's, in voxels; the last lane is zero.
class Offset {
 public:
  explicit Offset(const VoxelGrid& grid)
      : scale_(_mm_set1_ps(static_cast<float>(1 / grid.voxel_size))) {}

  __m128 operator()(__m128 from, __m128 to) const {
    return _mm_mul_ps(scale_, _mm_sub_ps(to, from));
  }

 private:
  __m128 scale_;
};

__m128 Load(const Eigen::Vector3f& p) {
  const __m128 xy = _mm_castpd_ps(_mm_load_sd(reinterpret_cast<const double*>(p.data())));
  return _mm_movelh_ps(xy, _mm_load_ss(p.data() + 2));
}

// A voxel's centroid, and the moments of those of itself and its neighbours about it. Side by side,
// as they are read together.
struct Ring {
  __m128 centroid;
  Moments moments;
};

LargeVector<Ring> FindRings(const VoxelGrid& grid, int num_threads) {
  LargeVector<Ring> rings(grid.size());
  const Offset offset(grid);
  ParallelFor(grid.size(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t voxel = first; voxel < last; ++voxel) {
      const __m128 centroid = Load(grid.centroids[voxel]);
      Moments own = Moments::OfPlace();
      for (const std::uint32_t other : grid.NeighboursOf(voxel)) {
        own.Add(offset(centroid, Load(grid.centroids[other])));
      }
      rings[voxel] = {centroid, own};
    }
  });
  return rings;
}

// Of the points within two steps.
Moments MomentsAround(const VoxelGrid& grid,
                      const LargeVector<Ring>& rings,
                      const Offset& offset,
                      std::size_t voxel) {
  const Ring& own = rings[voxel];
  Moments moments = own.moments;
  for (const std::uint32_t other : grid.NeighboursOf(voxel)) {
    moments.Add(rings[other].moments, offset(own.centroid, rings[other].centroid));
  }
  return moments;
}

// Three numbers for each of four voxels.
struct FourVectors {
  __m128 x;
  __m128 y;
  __m128 z;

  __m128 Dot(const FourVectors& other) const {
    return _mm_add_ps(_mm_mul_ps(x, other.x),
                      _mm_add_ps(_mm_mul_ps(y, other.y), _mm_mul_ps(z, other.z)));
  }
  FourVectors Cross(const FourVectors& other) const {
    return {_mm_sub_ps(_mm_mul_ps(y, other.z), _mm_mul_ps(z, other.y)),
            _mm_sub_ps(_mm_mul_ps(z, other.x), _mm_mul_ps(x, other.z)),
            _mm_sub_ps(_mm_mul_ps(x, other.y), _mm_mul_ps(y, other.x))};
  }
};

// Upper triangles of the covariances of the points of four voxels.
struct FourCovariances {
  FourVectors diagonal;  // xx, yy, zz.
  FourVectors beside;    // yz, zx, xy.

  FourVectors Row0() const { return {diagonal.x, beside.z, beside.y}; }
  FourVectors Row1() const { return {beside.z, diagonal.y, beside.x}; }
  FourVectors Row2() const { return {beside.y, beside.x, diagonal.z}; }

  __m128 Trace() const { return _mm_add_ps(diagonal.x, _mm_add_ps(diagonal.y, diagonal.z)); }
  // Sum of the principal minors.
  __m128 Minors() const {
    const auto& [xx, yy, zz] = diagonal;
    const auto& [yz, zx, xy] = beside;
    __m128 sum = _mm_sub_ps(_mm_mul_ps(xx, yy), _mm_mul_ps(xy, xy));
    sum = _mm_sub_ps(_mm_add_ps(sum, _mm_mul_ps(xx, zz)), _mm_mul_ps(zx, zx));
    return _mm_sub_ps(_mm_add_ps(sum, _mm_mul_ps(yy, zz)), _mm_mul_ps(yz, yz));
  }
  __m128 Determinant() const {
    const auto& [xx, yy, zz] = diagonal;
    const auto& [yz, zx, xy] = beside;
    const auto minor = [](__m128 a, __m128 b, __m128 c, __m128 d) {
      return _mm_sub_ps(_mm_mul_ps(a, b), _mm_mul_ps(c, d));
    };
    return _mm_add_ps(
        _mm_sub_ps(_mm_mul_ps(xx, minor(yy, zz, yz, yz)), _mm_mul_ps(xy, minor(xy, zz, yz, zx))),
        _mm_mul_ps(zx, minor(xy, yz, yy, zx)));
  }
};

// The least roots of the characteristic polynomials of four covariances, whose roots are not
// negative: from zero Newton's steps rise towards them and never pass them.
__m128 LeastEigenvalues(__m128 trace, __m128 minors, __m128 determinant) {
  constexpr int kMaxSteps = 12;
  const __m128 tolerance = _mm_set1_ps(1e-5F);
  const __m128 two_traces = _mm_mul_ps(_mm_set1_ps(2), trace);
  __m128 value = _mm_setzero_ps();
  __m128 is_open = _mm_cmpeq_ps(value, value);
  for (int i = 0; i < kMaxSteps && _mm_movemask_ps(is_open) != 0; ++i) {
    const __m128 slope = _mm_add_ps(
        _mm_mul_ps(_mm_sub_ps(_mm_mul_ps(_mm_set1_ps(3), value), two_traces), value), minors);
    is_open = _mm_and_ps(is_open, _mm_cmpgt_ps(slope, _mm_setzero_ps()));
    const __m128 rest = _mm_sub_ps(
        determinant,
        _mm_mul_ps(_mm_add_ps(_mm_mul_ps(_mm_sub_ps(value, trace), value), minors), value));
    const __m128 step = _mm_and_ps(is_open, _mm_div_ps(rest, slope));
    value = _mm_add_ps(value, step);
    is_open = _mm_and_ps(is_open, _mm_cmpgt_ps(step, _mm_mul_ps(tolerance, value)));
  }
  return value;
}

// Of equally long ones the first.
FourVectors Longest(const FourVectors& a, const FourVectors& b) {
  const __m128 is_longer = _mm_cmpgt_ps(b.Dot(b), a.Dot(a));
  return {Choose(is_longer, b.x, a.x), Choose(is_longer, b.y, a.y), Choose(is_longer, b.z, a.z)};
}

// The directions in which the covariances are least; zero where the points lie on a line.
FourVectors LeastDirections(FourCovariances c) {
  const __m128 trace = c.Trace();
  const __m128 minors = c.Minors();
  const __m128 least = LeastEigenvalues(trace, minors, c.Determinant());
  // The other eigenvalues from their sum and their product.
  const __m128 sum = _mm_sub_ps(trace, least);
  const __m128 half_sum = _mm_mul_ps(_mm_set1_ps(0.5F), sum);
  const __m128 product = _mm_sub_ps(minors, _mm_mul_ps(least, sum));
  const __m128 root = _mm_sqrt_ps(
      _mm_max_ps(_mm_setzero_ps(), _mm_sub_ps(_mm_mul_ps(half_sum, half_sum), product)));
  const __m128 min_spread = _mm_set1_ps(1e-3F);
  const __m128 is_plane =
      _mm_cmpgt_ps(_mm_sub_ps(half_sum, root), _mm_mul_ps(min_spread, _mm_add_ps(half_sum, root)));
  // Square to all rows of what is left of the covariance.
  c.diagonal = {_mm_sub_ps(c.diagonal.x, least), _mm_sub_ps(c.diagonal.y, least),
                _mm_sub_ps(c.diagonal.z, least)};
  const FourVectors best = Longest(Longest(c.Row0().Cross(c.Row1()), c.Row0().Cross(c.Row2())),
                                   c.Row1().Cross(c.Row2()));
  const __m128 squared_norm = best.Dot(best);
  const __m128 norm = _mm_sqrt_ps(squared_norm);
  const __m128 is_direction = _mm_cmpgt_ps(squared_norm, _mm_setzero_ps());
  const auto normalised = [&](__m128 v) {
    return _mm_and_ps(is_plane, Choose(is_direction, _mm_div_ps(v, norm), v));
  };
  return {normalised(best.x), normalised(best.y), normalised(best.z)};
}

struct FourNumbers {
  __m128 first;
  __m128 second;
  __m128 third;
  __m128 fourth;
};

// Moments of four voxels, lane by lane.
class FourMoments {
 public:
  void Set(std::size_t lane, const Moments& moments) { moments_[lane] = moments; }

  // Zero where the points leave the plane open.
  FourVectors Normals() const {
    const auto [x, y, z, count] = Turn(&Moments::sum);
    const auto [xx, yy, zz, none] = Turn(&Moments::squares);
    const auto [yz, zx, xy, nothing] = Turn(&Moments::products);
    const __m128 scale = _mm_div_ps(_mm_set1_ps(1), count);
    const FourVectors mean = {_mm_mul_ps(scale, x), _mm_mul_ps(scale, y), _mm_mul_ps(scale, z)};
    const auto central = [&](__m128 product, __m128 a, __m128 b) {
      return _mm_sub_ps(_mm_mul_ps(scale, product), _mm_mul_ps(a, b));
    };
    const FourVectors directions = LeastDirections(
        {{central(xx, mean.x, mean.x), central(yy, mean.y, mean.y), central(zz, mean.z, mean.z)},
         {central(yz, mean.y, mean.z), central(zx, mean.z, mean.x), central(xy, mean.x, mean.y)}});
    const __m128 is_enough = _mm_cmpge_ps(count, _mm_set1_ps(3));
    return {_mm_and_ps(is_enough, directions.x), _mm_and_ps(is_enough, directions.y),
            _mm_and_ps(is_enough, directions.z)};
  }

 private:
  // From four numbers a voxel to the same number of the four voxels.
  FourNumbers Turn(__m128 Moments::*numbers) const {
    __m128 a = moments_[0].*numbers;
    __m128 b = moments_[1].*numbers;
    __m128 c = moments_[2].*numbers;
    __m128 d = moments_[3].*numbers;
    _MM_TRANSPOSE4_PS(a, b, c, d);
    return {a, b, c, d};
  }

  std::array<Moments, 4> moments_{};
};

// The voxels of known side that touch others; ascending.
std::vector<std::uint32_t> FindKnownBeside(const VoxelGrid& grid,
                                           const std::vector<std::uint32_t>& unknown) {
  std::vector<std::uint32_t> beside;
  for (const std::uint32_t voxel : unknown) {
    for (const std::uint32_t other : grid.NeighboursOf(voxel)) {
      if (!grid.views[other].isZero(0)) beside.push_back(other);
    }
  }
  std::sort(beside.begin(), beside.end());
  beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
  return beside;
}

// Turns normals of unknown side like their neighbours', breadth first from those that are known,
// then from the first of each remaining surface.
void OrientTheRest(const VoxelGrid& grid, std::vector<Eigen::Vector3f>& normals) {
  std::vector<std::uint32_t> unknown;
  for (std::uint32_t voxel = 0; voxel < grid.size(); ++voxel) {
    if (grid.views[voxel].isZero(0)) unknown.push_back(voxel);
  }
  if (unknown.empty()) return;
  std::vector<bool> is_known(grid.size(), true);
  for (const std::uint32_t voxel : unknown) is_known[voxel] = false;
  std::vector<std::uint32_t> queue = FindKnownBeside(grid, unknown);
  std::size_t next = 0;
  const auto turn_around = [&] {
    while (next < queue.size()) {
      const std::uint32_t voxel = queue[next++];
      for (const std::uint32_t other : grid.NeighboursOf(voxel)) {
        if (is_known[other]) continue;
        if (normals[other].dot(normals[voxel]) < 0) normals[other] = -normals[other];
        is_known[other] = true;
        queue.push_back(other);
      }
    }
  };
  turn_around();
  for (const std::uint32_t start : unknown) {
    if (is_known[start]) continue;
    is_known[start] = true;
    queue.push_back(start);
    turn_around();
  }
}

}  // namespace

std::vector<Eigen::Vector3f> ComputeVoxelNormals(const VoxelGrid& grid, int num_threads) {
  const LargeVector<Ring> rings = FindRings(grid, num_threads);
  const Offset offset(grid);
  std::vector<Eigen::Vector3f> normals(grid.size());
  ParallelFor(grid.size(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    FourMoments moments;
    for (std::size_t begin = first; begin < last; begin += 4) {
      const std::size_t num_lanes = std::min<std::size_t>(last - begin, 4);
      for (std::size_t lane = 0; lane < num_lanes; ++lane) {
        moments.Set(lane, MomentsAround(grid, rings, offset, begin + lane));
      }
      const FourVectors directions = moments.Normals();
      alignas(16) std::array<std::array<float, 4>, 3> rows{};
      _mm_store_ps(rows[0].data(), directions.x);
      _mm_store_ps(rows[1].data(), directions.y);
      _mm_store_ps(rows[2].data(), directions.z);
      for (std::size_t lane = 0; lane < num_lanes; ++lane) {
        const Eigen::Vector3f normal(rows[0][lane], rows[1][lane], rows[2][lane]);
        const bool is_turned = normal.dot(grid.views[begin + lane]) < 0;
        normals[begin + lane] = is_turned ? Eigen::Vector3f(-normal) : normal;
      }
    }
  });
  OrientTheRest(grid, normals);
  return normals;
}

}  // namespace semslam

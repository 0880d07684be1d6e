// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/voxel_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>

#include <Eigen/Geometry>
#include <emmintrin.h>

#include "semslam/base/parallel.h"

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

  float count() const { return _mm_cvtss_f32(_mm_shuffle_ps(sum, sum, _MM_SHUFFLE(3, 3, 3, 3))); }

  Eigen::Matrix3f Covariance() const {
    const __m128 scale = _mm_set1_ps(1 / count());
    const __m128 mean = _mm_mul_ps(scale, sum);
    alignas(16) std::array<float, 4> d{};
    alignas(16) std::array<float, 4> p{};
    _mm_store_ps(d.data(), _mm_sub_ps(_mm_mul_ps(scale, squares), _mm_mul_ps(mean, mean)));
    _mm_store_ps(p.data(),
                 _mm_sub_ps(_mm_mul_ps(scale, products), _mm_mul_ps(Yzx(mean), Zxy(mean))));
    Eigen::Matrix3f covariance;
    covariance << d[0], p[2], p[1],  //
        p[2], d[1], p[0],            //
        p[1], p[0], d[2];
    return covariance;
  }

 private:
  static __m128 Yzx(__m128 v) { return _mm_shuffle_ps(v, v, _MM_SHUFFLE(3, 0, 2, 1)); }
  static __m128 Zxy(__m128 v) { return _mm_shuffle_ps(v, v, _MM_SHUFFLE(3, 1, 0, 2)); }
};

// Centroids of voxels, in voxels.
class Places {
 public:
  explicit Places(const VoxelGrid& grid)
      : centroids_(grid.centroids), scale_(_mm_set1_ps(static_cast<float>(1 / grid.voxel_size))) {}

  // From the one to the other; the last lane is zero.
  __m128 Offset(std::size_t from, std::size_t to) const {
    return _mm_mul_ps(scale_, _mm_sub_ps(Load(centroids_[to]), Load(centroids_[from])));
  }

 private:
  static __m128 Load(const Eigen::Vector3f& p) {
    const __m128 xy = _mm_unpacklo_ps(_mm_load_ss(p.data()), _mm_load_ss(p.data() + 1));
    return _mm_movelh_ps(xy, _mm_load_ss(p.data() + 2));
  }

  const std::vector<Eigen::Vector3f>& centroids_;
  __m128 scale_;
};

// Of each voxel's centroid and those of its neighbours, about its own.
std::unique_ptr<Moments[]> RingMoments(const VoxelGrid& grid, int num_threads) {
  auto moments = std::make_unique_for_overwrite<Moments[]>(grid.size());
  const Places places(grid);
  ParallelFor(grid.size(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t voxel = first; voxel < last; ++voxel) {
      Moments own = Moments::OfPlace();
      for (const std::uint32_t other : grid.NeighboursOf(voxel)) {
        own.Add(places.Offset(voxel, other));
      }
      moments[voxel] = own;
    }
  });
  return moments;
}

// The least root of the characteristic polynomial of a covariance, whose roots are not negative:
// from zero Newton's steps rise towards it and never pass it.
float LeastEigenvalue(float trace, float minors, float determinant) {
  constexpr int kMaxSteps = 12;
  constexpr float kTolerance = 1e-5F;
  float value = 0;
  for (int i = 0; i < kMaxSteps; ++i) {
    const float slope = (3 * value - 2 * trace) * value + minors;
    if (!(slope > 0)) break;
    const float step = (determinant - ((value - trace) * value + minors) * value) / slope;
    value += step;
    if (!(step > kTolerance * value)) break;
  }
  return value;
}

// Zero if the points lie on a line.
Eigen::Vector3f LeastDirection(const Moments& moments) {
  if (moments.count() < 3) return Eigen::Vector3f::Zero();
  constexpr float kMinSpread = 1e-3F;
  Eigen::Matrix3f c = moments.Covariance();
  const float trace = c.trace();
  const float minors = c(0, 0) * c(1, 1) - c(0, 1) * c(0, 1) + c(0, 0) * c(2, 2) -
                       c(0, 2) * c(0, 2) + c(1, 1) * c(2, 2) - c(1, 2) * c(1, 2);
  const float least = LeastEigenvalue(trace, minors, c.determinant());
  // The others from their sum and their product.
  const float half_sum = 0.5F * (trace - least);
  const float product = minors - least * (trace - least);
  const float root = std::sqrt(std::max(half_sum * half_sum - product, 0.0F));
  if (!(half_sum - root > kMinSpread * (half_sum + root))) return Eigen::Vector3f::Zero();
  // Square to all rows of what is left of the covariance.
  c.diagonal().array() -= least;
  Eigen::Vector3f best = c.row(0).cross(c.row(1));
  for (const Eigen::Vector3f& other :
       {Eigen::Vector3f(c.row(0).cross(c.row(2))), Eigen::Vector3f(c.row(1).cross(c.row(2)))}) {
    if (other.squaredNorm() > best.squaredNorm()) best = other;
  }
  return best.normalized();
}

// Turns normals of unknown side like their neighbours', breadth first from those that are known,
// then from the first of each remaining surface.
void OrientTheRest(const VoxelGrid& grid, std::vector<Eigen::Vector3f>& normals) {
  const bool is_complete = std::none_of(grid.views.begin(), grid.views.end(),
                                        [](const Eigen::Vector3f& view) { return view.isZero(0); });
  if (is_complete) return;
  std::vector<bool> is_known(grid.size());
  std::vector<std::uint32_t> queue;
  for (std::size_t voxel = 0; voxel < grid.size(); ++voxel) {
    is_known[voxel] = !grid.views[voxel].isZero(0);
    if (is_known[voxel]) queue.push_back(static_cast<std::uint32_t>(voxel));
  }
  std::size_t next = 0;
  for (std::size_t start = 0; start <= grid.size(); ++start) {
    while (next < queue.size()) {
      const std::uint32_t voxel = queue[next++];
      for (const std::uint32_t other : grid.NeighboursOf(voxel)) {
        if (is_known[other]) continue;
        if (normals[other].dot(normals[voxel]) < 0) normals[other] = -normals[other];
        is_known[other] = true;
        queue.push_back(other);
      }
    }
    if (start < grid.size() && !is_known[start]) {
      is_known[start] = true;
      queue.push_back(static_cast<std::uint32_t>(start));
    }
  }
}

}  // namespace

std::vector<Eigen::Vector3f> ComputeVoxelNormals(const VoxelGrid& grid, int num_threads) {
  const std::unique_ptr<Moments[]> rings = RingMoments(grid, num_threads);
  const Places places(grid);
  std::vector<Eigen::Vector3f> normals(grid.size());
  ParallelFor(grid.size(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t voxel = first; voxel < last; ++voxel) {
      Moments moments = rings[voxel];
      for (const std::uint32_t other : grid.NeighboursOf(voxel)) {
        moments.Add(rings[other], places.Offset(voxel, other));
      }
      normals[voxel] = LeastDirection(moments);
      if (normals[voxel].dot(grid.views[voxel]) < 0) normals[voxel] = -normals[voxel];
    }
  });
  OrientTheRest(grid, normals);
  return normals;
}

}  // namespace semslam

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

#include "semslam/base/parallel.h"

namespace semslam {
namespace {

constexpr std::size_t kGrain = 8192;

// Moments in voxel units. Doubles, so that all can be taken about the same origin and simply added.
class Moments {
 public:
  // Of one point.
  static Moments Of(const Eigen::Vector3d& p) {
    Moments moments;
    for (Eigen::Array2d& lane : moments.lanes_) lane.setZero();
    moments.Add(p);
    return moments;
  }

  void Add(const Eigen::Vector3d& p) {
    lanes_[0] += Eigen::Array2d(1, p.x());
    lanes_[1] += Eigen::Array2d(p.y(), p.z());
    lanes_[2] += Eigen::Array2d(p.x() * p.x(), p.x() * p.y());
    lanes_[3] += Eigen::Array2d(p.x() * p.z(), p.y() * p.y());
    lanes_[4] += Eigen::Array2d(p.y() * p.z(), p.z() * p.z());
  }

  Moments& operator+=(const Moments& other) {
    for (std::size_t i = 0; i < lanes_.size(); ++i) lanes_[i] += other.lanes_[i];
    return *this;
  }

  double weight() const { return lanes_[0][0]; }

  Eigen::Matrix3f Covariance() const {
    const double scale = 1 / weight();
    const Eigen::Vector3d mean = scale * Eigen::Vector3d(lanes_[0][1], lanes_[1][0], lanes_[1][1]);
    Eigen::Matrix3d outer;
    outer << lanes_[2][0], lanes_[2][1], lanes_[3][0],  //
        lanes_[2][1], lanes_[3][1], lanes_[4][0],       //
        lanes_[3][0], lanes_[4][0], lanes_[4][1];
    return (scale * outer - mean * mean.transpose()).cast<float>();
  }

 private:
  // 1 x | y z | xx xy | xz yy | yz zz.
  std::array<Eigen::Array2d, 5> lanes_;
};

std::unique_ptr<Moments[]> RingMoments(const VoxelGrid& grid, int num_threads) {
  auto moments = std::make_unique_for_overwrite<Moments[]>(grid.size());
  const double scale = 1.0 / grid.voxel_size;
  ParallelFor(grid.size(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t voxel = first; voxel < last; ++voxel) {
      Moments own = Moments::Of(scale * grid.centroids[voxel].cast<double>());
      for (const std::uint32_t other : grid.NeighboursOf(voxel)) {
        own.Add(scale * grid.centroids[other].cast<double>());
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
  if (moments.weight() < 3) return Eigen::Vector3f::Zero();
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
  std::vector<Eigen::Vector3f> normals(grid.size(), Eigen::Vector3f::Zero());
  ParallelFor(grid.size(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t voxel = first; voxel < last; ++voxel) {
      Moments moments = rings[voxel];
      for (const std::uint32_t other : grid.NeighboursOf(voxel)) moments += rings[other];
      normals[voxel] = LeastDirection(moments);
      if (normals[voxel].dot(grid.views[voxel]) < 0) normals[voxel] = -normals[voxel];
    }
  });
  OrientTheRest(grid, normals);
  return normals;
}

}  // namespace semslam

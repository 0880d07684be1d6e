// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/voxel_normals.h"

#include <cstddef>
#include <cstdint>

#include <Eigen/Eigenvalues>

#include "semslam/base/parallel.h"

namespace semslam {
namespace {

constexpr std::size_t kGrain = 8192;

// Moments in voxel units about the low corner of the voxel they belong to: small numbers, for which
// floats do.
struct LocalMoments {
  float weight = 0;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  Eigen::Matrix<float, 6, 1> outer = Eigen::Matrix<float, 6, 1>::Zero();  // xx xy xz yy yz zz.

  void Add(const Eigen::Vector3f& p) {
    weight += 1;
    sum += p;
    outer += Products(p, p);
  }

  // Adds moments about a corner that lies `shift` away from the own one.
  void AddShifted(const LocalMoments& other, const Eigen::Vector3f& shift) {
    weight += other.weight;
    sum += other.sum + other.weight * shift;
    outer += other.outer + Products(other.sum, shift) + Products(shift, other.sum) +
             other.weight * Products(shift, shift);
  }

  Eigen::Matrix3f Covariance() const {
    const Eigen::Vector3f mean = sum / weight;
    const Eigen::Matrix<float, 6, 1> c = outer / weight - Products(mean, mean);
    Eigen::Matrix3f matrix;
    matrix << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5];
    return matrix;
  }

 private:
  // The upper triangle of a b^T.
  static Eigen::Matrix<float, 6, 1> Products(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    Eigen::Matrix<float, 6, 1> products;
    products << a.x() * b.x(), a.x() * b.y(), a.x() * b.z(), a.y() * b.y(), a.y() * b.z(),
        a.z() * b.z();
    return products;
  }
};

std::vector<LocalMoments> RingMoments(const VoxelGrid& grid, int num_threads) {
  std::vector<LocalMoments> moments(grid.size());
  const float scale = static_cast<float>(1.0 / grid.voxel_size);
  ParallelFor(grid.size(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t voxel = first; voxel < last; ++voxel) {
      const Eigen::Vector3f corner = (grid.cells[voxel] - Eigen::Vector3i::Ones()).cast<float>();
      LocalMoments& own = moments[voxel];
      own.Add(grid.centroids[voxel] * scale - corner);
      for (const std::uint32_t other : grid.NeighboursOf(voxel)) {
        own.Add(grid.centroids[other] * scale - corner);
      }
    }
  });
  return moments;
}

// Zero if the points lie on a line.
Eigen::Vector3f LeastDirection(const LocalMoments& moments) {
  if (moments.weight < 3) return Eigen::Vector3f::Zero();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
  solver.computeDirect(moments.Covariance());
  constexpr float kMinSpread = 1e-3F;
  if (!(solver.eigenvalues()[1] > kMinSpread * solver.eigenvalues()[2])) {
    return Eigen::Vector3f::Zero();
  }
  return solver.eigenvectors().col(0);
}

// Turns normals of unknown side like their neighbours', breadth first from those that are known,
// then from the first of each remaining surface.
void OrientTheRest(const VoxelGrid& grid,
                   std::vector<bool>& is_known,
                   std::vector<Eigen::Vector3f>& normals) {
  std::vector<std::uint32_t> queue;
  for (std::size_t voxel = 0; voxel < grid.size(); ++voxel) {
    if (is_known[voxel]) queue.push_back(static_cast<std::uint32_t>(voxel));
  }
  if (queue.size() == grid.size()) return;
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
  const std::vector<LocalMoments> rings = RingMoments(grid, num_threads);
  std::vector<Eigen::Vector3f> normals(grid.size(), Eigen::Vector3f::Zero());
  ParallelFor(grid.size(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t voxel = first; voxel < last; ++voxel) {
      LocalMoments moments = rings[voxel];
      for (const std::uint32_t other : grid.NeighboursOf(voxel)) {
        moments.AddShifted(rings[other], (grid.cells[other] - grid.cells[voxel]).cast<float>());
      }
      normals[voxel] = LeastDirection(moments);
      if (normals[voxel].dot(grid.views[voxel]) < 0) normals[voxel] = -normals[voxel];
    }
  });
  std::vector<bool> is_known(grid.size());
  for (std::size_t voxel = 0; voxel < grid.size(); ++voxel) {
    is_known[voxel] = !grid.views[voxel].isZero();
  }
  OrientTheRest(grid, is_known, normals);
  return normals;
}

}  // namespace semslam

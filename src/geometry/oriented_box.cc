// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/geometry/oriented_box.h"

#include <algorithm>
#include <array>
#include <vector>

#include <Eigen/Eigenvalues>

namespace semslam {
namespace {

using Polygon = std::vector<Eigen::Vector3d>;

// The principal directions of the points, most extent first, as the columns of a rotation.
Eigen::Matrix3d PrincipalAxes(std::span<const Eigen::Vector3d> points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) mean += point;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points) {
    covariance += (point - mean) * (point - mean).transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  Eigen::Matrix3d axes = solver.eigenvectors().rowwise().reverse();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

// The six faces of a box as polygons, in the frame of T * box.
std::array<Polygon, 6> Faces(const Rigid3& T_frame_box, const Eigen::Vector3d& half_size) {
  std::array<Polygon, 6> faces;
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      Eigen::Vector3d corner;
      for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        corner[axis] = (side == 0 ? -1.0 : 1.0) * half_size[axis];
        corner[(axis + 1) % 3] = u * half_size[(axis + 1) % 3];
        corner[(axis + 2) % 3] = v * half_size[(axis + 2) % 3];
        faces[2 * axis + side].push_back(T_frame_box * corner);
      }
    }
  }
  return faces;
}

// Keeps the part with sign * p[axis] <= limit (Sutherland and Hodgman).
Polygon ClipAxis(const Polygon& polygon, int axis, double sign, double limit) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d& a = polygon[i];
    const Eigen::Vector3d& b = polygon[(i + 1) % polygon.size()];
    const double excess_a = sign * a[axis] - limit;
    const double excess_b = sign * b[axis] - limit;
    if (excess_a <= 0) result.push_back(a);
    if ((excess_a < 0 && excess_b > 0) || (excess_a > 0 && excess_b < 0)) {
      result.push_back(a + (b - a) * (excess_a / (excess_a - excess_b)));
    }
  }
  return result;
}

Polygon ClipToBox(Polygon polygon, const Eigen::Vector3d& half_size) {
  for (int axis = 0; axis < 3; ++axis) {
    polygon = ClipAxis(polygon, axis, 1.0, half_size[axis]);
    polygon = ClipAxis(polygon, axis, -1.0, half_size[axis]);
  }
  return polygon;
}

// Volume of the cone from `apex` over a planar polygon.
double ConeVolume(const Polygon& polygon, const Eigen::Vector3d& apex) {
  double volume = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Eigen::Vector3d a = polygon[0] - apex;
    const Eigen::Vector3d b = polygon[i - 1] - apex;
    volume += a.cross(b).dot(polygon[i] - apex) / 6.0;
  }
  return std::abs(volume);
}

// The intersection is convex: cut it into cones from a point inside over its faces, which are the
// faces of each box clipped with the other box.
double IntersectionVolume(const OrientedBox& a, const OrientedBox& b) {
  const Rigid3 T_a_b = a.T_world_box.Inverse() * b.T_world_box;
  const Rigid3 T_b_a = T_a_b.Inverse();
  std::vector<Polygon> faces_a;
  for (const Polygon& face : Faces(T_a_b, b.half_size)) {
    faces_a.push_back(ClipToBox(face, a.half_size));
  }
  for (const Polygon& face : Faces(T_b_a, a.half_size)) {
    Polygon clipped = ClipToBox(face, b.half_size);
    for (Eigen::Vector3d& corner : clipped) corner = T_a_b * corner;
    faces_a.push_back(std::move(clipped));
  }
  Eigen::Vector3d inside = Eigen::Vector3d::Zero();
  int num_corners = 0;
  for (const Polygon& face : faces_a) {
    for (const Eigen::Vector3d& corner : face) {
      inside += corner;
      ++num_corners;
    }
  }
  if (num_corners == 0) return 0.0;
  inside /= num_corners;
  double volume = 0;
  for (const Polygon& face : faces_a) volume += ConeVolume(face, inside);
  return volume;
}

}  // namespace

bool OrientedBox::Contains(const Eigen::Vector3d& p_world) const {
  const Eigen::Vector3d p_box = T_world_box.Inverse() * p_world;
  return (p_box.cwiseAbs().array() <= half_size.array()).all();
}

OrientedBox FitOrientedBox(std::span<const Eigen::Vector3d> points) {
  if (points.empty()) return {};
  const Eigen::Matrix3d axes = PrincipalAxes(points);
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d p = axes.transpose() * point;
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Eigen::Vector3d center = 0.5 * (low + high);
  return {{Eigen::Quaterniond(axes).normalized(), axes * center}, 0.5 * (high - low)};
}

double IntersectionOverUnion(const OrientedBox& a, const OrientedBox& b) {
  const double sum = a.Volume() + b.Volume();
  if (sum <= 0) return 0.0;
  const double intersection = std::min({IntersectionVolume(a, b), a.Volume(), b.Volume()});
  return intersection / (sum - intersection);
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/geometry/oriented_box.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
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

// The six faces of a box as polygons, in the frame that T_frame_box leads to.
std::vector<Polygon> Faces(const Rigid3& T_frame_box, const Eigen::Vector3d& half_size) {
  std::vector<Polygon> faces(6);
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

// The half-space sign * p[axis] <= limit.
struct HalfSpace {
  int axis;
  double sign;
  double limit;

  // Signed distance to its border, positive outside; 0 within rounding, so that faces in one plane
  // count once.
  double Excess(const Eigen::Vector3d& p) const {
    const double excess = sign * p[axis] - limit;
    return std::abs(excess) <= kTolerance ? 0.0 : excess;
  }

  static constexpr double kTolerance = 1e-9;  // Metres.
};

// The part of a polygon in the half-space (Sutherland and Hodgman).
Polygon ClipPolygon(const Polygon& polygon, const HalfSpace& space) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d& a = polygon[i];
    const Eigen::Vector3d& b = polygon[(i + 1) % polygon.size()];
    const double excess_a = space.Excess(a);
    const double excess_b = space.Excess(b);
    if (excess_a <= 0) result.push_back(a);
    if ((excess_a < 0 && excess_b > 0) || (excess_a > 0 && excess_b < 0)) {
      result.push_back(a + (b - a) * (excess_a / (excess_a - excess_b)));
      result.back()[space.axis] = space.sign * space.limit;
    }
  }
  return result;
}

// The convex polygon whose corners are the given points of a plane across `axis`.
Polygon OrderCorners(Polygon corners, int axis) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& corner : corners) center += corner;
  center /= static_cast<double>(corners.size());
  const auto angle = [&](const Eigen::Vector3d& p) {
    return std::atan2(p[v] - center[v], p[u] - center[u]);
  };
  std::sort(corners.begin(), corners.end(),
            [&](const auto& a, const auto& b) { return angle(a) < angle(b); });
  return corners;
}

// The part of a convex body, given by its faces, in the half-space. Where something is cut off, a
// face closes the hole.
std::vector<Polygon> ClipBody(const std::vector<Polygon>& faces, const HalfSpace& space) {
  std::vector<Polygon> result;
  Polygon cut;
  bool cuts = false;
  for (const Polygon& face : faces) {
    cuts |=
        std::any_of(face.begin(), face.end(), [&](const auto& p) { return space.Excess(p) > 0; });
    Polygon clipped = ClipPolygon(face, space);
    for (const Eigen::Vector3d& corner : clipped) {
      if (space.Excess(corner) == 0) cut.push_back(corner);
    }
    if (clipped.size() >= 3) result.push_back(std::move(clipped));
  }
  if (cuts && cut.size() >= 3) result.push_back(OrderCorners(std::move(cut), space.axis));
  return result;
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

// The intersection is convex: cut it into cones from a point inside over its faces.
double IntersectionVolume(const OrientedBox& a, const OrientedBox& b) {
  std::vector<Polygon> faces = Faces(a.T_world_box.Inverse() * b.T_world_box, b.half_size);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      faces = ClipBody(faces, {axis, sign, a.half_size[axis]});
    }
  }
  Eigen::Vector3d inside = Eigen::Vector3d::Zero();
  std::size_t num_corners = 0;
  for (const Polygon& face : faces) {
    for (const Eigen::Vector3d& corner : face) inside += corner;
    num_corners += face.size();
  }
  if (num_corners == 0) return 0.0;
  inside /= static_cast<double>(num_corners);
  double volume = 0;
  for (const Polygon& face : faces) volume += ConeVolume(face, inside);
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

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/geometry/oriented_box.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace semslam {
namespace {

// A convex body. Faces list their corners counterclockwise as seen from outside.
struct Polyhedron {
  std::vector<Eigen::Vector3d> corners;
  std::vector<std::vector<int>> faces;
};

// The principal directions of the points, most extent first, as the columns of a rotation.
Eigen::Matrix3d PrincipalAxes(std::span<const Eigen::Vector3d> points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) mean += point;
  mean /= static_cast<double>(points.size());
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  Eigen::Vector3d products = Eigen::Vector3d::Zero();  // yz, zx, xy.
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d p = point - mean;
    squares += p.cwiseProduct(p);
    products += Eigen::Vector3d(p.y() * p.z(), p.z() * p.x(), p.x() * p.y());
  }
  Eigen::Matrix3d covariance;
  covariance << squares.x(), products.z(), products.y(),  //
      products.z(), squares.y(), products.x(),            //
      products.y(), products.x(), squares.z();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  Eigen::Matrix3d axes = solver.eigenvectors().rowwise().reverse();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Counterclockwise, without points on its edges: Andrew's monotone chain.
std::vector<Eigen::Vector2d> ConvexHull(std::vector<Eigen::Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  std::vector<Eigen::Vector2d> hull;
  const auto add_chain = [&hull](auto begin, auto end) {
    const std::size_t first = hull.size();
    for (auto point = begin; point != end; ++point) {
      while (hull.size() >= first + 2 &&
             Cross(hull.back() - hull[hull.size() - 2], *point - hull.back()) <= 0) {
        hull.pop_back();
      }
      hull.push_back(*point);
    }
    hull.pop_back();  // The other chain begins with it.
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull.empty() ? std::vector<Eigen::Vector2d>{points.front()} : hull;
}

// The direction of the longer side of the rectangle of least area around the points: one of its
// sides lies on an edge of the convex hull.
Eigen::Vector2d LongSideOfLeastRectangle(const std::vector<Eigen::Vector2d>& points) {
  const std::vector<Eigen::Vector2d> hull = ConvexHull(points);
  double least_area = std::numeric_limits<double>::infinity();
  Eigen::Vector2d long_side = Eigen::Vector2d::UnitX();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d edge = hull[(i + 1) % hull.size()] - hull[i];
    if (edge.norm() == 0) continue;
    const Eigen::Vector2d along = edge.normalized();
    const Eigen::Vector2d across(-along.y(), along.x());
    Eigen::AlignedBox2d extent;
    for (const Eigen::Vector2d& corner : hull) {
      extent.extend(Eigen::Vector2d(along.dot(corner), across.dot(corner)));
    }
    if (extent.volume() >= least_area) continue;
    least_area = extent.volume();
    long_side = extent.sizes().x() >= extent.sizes().y() ? along : across;
  }
  return long_side;
}

// Around points with the axes that are the columns of a rotation.
OrientedBox BoxWithAxes(std::span<const Eigen::Vector3d> points, const Eigen::Matrix3d& axes) {
  Eigen::AlignedBox3d extent;
  for (const Eigen::Vector3d& point : points) extent.extend(axes.transpose() * point);
  return {{Eigen::Quaterniond(axes).normalized(), axes * extent.center()}, 0.5 * extent.sizes()};
}

// A box as a body in the frame that T_frame_box leads to. Bit k of a corner's index says on which
// side of axis k it is.
Polyhedron ToPolyhedron(const Rigid3& T_frame_box, const Eigen::Vector3d& half_size) {
  Polyhedron body;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d side((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    body.corners.push_back(T_frame_box * half_size.cwiseProduct(side));
  }
  body.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return body;
}

// Cuts a body with a half-space. Every corner is judged once and every edge cut once, for all faces
// they belong to: so the result is closed also where a face lies in the border of the half-space
// and rounding decides.
class Clipper {
 public:
  // Keeps sign * p[axis] <= limit.
  Clipper(Polyhedron body, int axis, double sign, double limit) : body_(std::move(body)) {
    for (const Eigen::Vector3d& corner : body_.corners) {
      excess_.push_back(sign * corner[axis] - limit);
    }
  }

  Polyhedron Clip() && {
    std::vector<std::vector<int>> faces;
    for (const std::vector<int>& face : body_.faces) faces.push_back(ClipFace(face));
    while (!next_on_cut_.empty()) faces.push_back(TakeLoop());
    std::erase_if(faces, [](const std::vector<int>& face) { return face.size() < 3; });
    body_.faces = std::move(faces);
    return std::move(body_);
  }

 private:
  bool IsInside(int corner) const { return excess_[corner] <= 0; }

  // Sutherland and Hodgman; notes the new edges for the face that closes the hole.
  std::vector<int> ClipFace(const std::vector<int>& face) {
    std::vector<int> kept;
    std::vector<int> exits;
    std::vector<int> entries;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const int a = face[i];
      const int b = face[(i + 1) % face.size()];
      if (IsInside(a)) kept.push_back(a);
      if (IsInside(a) == IsInside(b)) continue;
      kept.push_back(CutEdge(a, b));
      (IsInside(a) ? exits : entries).push_back(kept.back());
    }
    // Exits and entries alternate; the way outside may begin before the first corner.
    const std::size_t shift = !face.empty() && !IsInside(face[0]) ? 1 : 0;
    for (std::size_t i = 0; i < exits.size(); ++i) {
      next_on_cut_[entries[(i + shift) % entries.size()]] = exits[i];
    }
    return kept;
  }

  int CutEdge(int a, int b) {
    const auto [entry, is_new] =
        cut_edges_.try_emplace(std::minmax(a, b), static_cast<int>(body_.corners.size()));
    if (is_new) {
      const double fraction = excess_[a] / (excess_[a] - excess_[b]);
      const Eigen::Vector3d corner =
          body_.corners[a] + fraction * (body_.corners[b] - body_.corners[a]);
      body_.corners.push_back(corner);
    }
    return entry->second;
  }

  std::vector<int> TakeLoop() {
    std::vector<int> loop;
    for (auto edge = next_on_cut_.begin(); edge != next_on_cut_.end();) {
      loop.push_back(edge->first);
      const int next = edge->second;
      next_on_cut_.erase(edge);
      edge = next_on_cut_.find(next);
    }
    return loop;
  }

  Polyhedron body_;
  std::vector<double> excess_;  // Of the corners before the cut; positive outside.
  std::map<std::pair<int, int>, int> cut_edges_;
  std::map<int, int> next_on_cut_;
};

// By the divergence theorem.
double Volume(const Polyhedron& body) {
  double volume = 0;
  for (const std::vector<int>& face : body.faces) {
    const Eigen::Vector3d& first = body.corners[face[0]];
    for (std::size_t i = 2; i < face.size(); ++i) {
      volume += first.dot(body.corners[face[i - 1]].cross(body.corners[face[i]])) / 6.0;
    }
  }
  return volume;
}

double IntersectionVolume(const OrientedBox& a, const OrientedBox& b) {
  Polyhedron body = ToPolyhedron(a.T_world_box.Inverse() * b.T_world_box, b.half_size);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      body = Clipper(std::move(body), axis, sign, a.half_size[axis]).Clip();
    }
  }
  return Volume(body);
}

}  // namespace

bool OrientedBox::Contains(const Eigen::Vector3d& p_world) const {
  const Eigen::Vector3d p_box = T_world_box.Inverse() * p_world;
  return (p_box.cwiseAbs().array() <= half_size.array()).all();
}

OrientedBox FitOrientedBox(std::span<const Eigen::Vector3d> points) {
  if (points.empty()) return {};
  return BoxWithAxes(points, PrincipalAxes(points));
}

OrientedBox FitUprightBox(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& up) {
  if (points.empty()) return {};
  const Eigen::Vector3d side = up.unitOrthogonal();
  const Eigen::Vector3d other = up.cross(side);
  std::vector<Eigen::Vector2d> ground;
  ground.reserve(points.size());
  for (const Eigen::Vector3d& point : points)
    ground.emplace_back(side.dot(point), other.dot(point));
  const Eigen::Vector2d long_side = LongSideOfLeastRectangle(ground);
  Eigen::Matrix3d axes;
  axes.col(0) = long_side.x() * side + long_side.y() * other;
  axes.col(2) = up;
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return BoxWithAxes(points, axes);
}

double IntersectionOverUnion(const OrientedBox& a, const OrientedBox& b) {
  const double sum = a.Volume() + b.Volume();
  if (sum <= 0) return 0.0;
  const double intersection =
      std::clamp(IntersectionVolume(a, b), 0.0, std::min(a.Volume(), b.Volume()));
  return intersection / (sum - intersection);
}

}  // namespace semslam

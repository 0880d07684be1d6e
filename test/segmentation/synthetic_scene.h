// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "semslam/base/random.h"
#include "semslam/geometry/rigid3.h"
#include "semslam/segmentation/segmenter.h"

namespace semslam::test {

// Points on known surfaces with the number of the surface's owner, in front of a viewer.
struct SyntheticScene {
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;
  std::vector<std::uint32_t> truth;

  PointCloudView View() const { return {points, normals}; }

  void Add(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, std::uint32_t owner) {
    points.push_back(point.cast<float>());
    normals.push_back(normal.cast<float>());
    truth.push_back(owner);
  }

  // A rectangle corner + s a + t b, sampled every `spacing`, normal along a x b.
  void AddRectangle(const Eigen::Vector3d& corner,
                    const Eigen::Vector3d& a,
                    const Eigen::Vector3d& b,
                    std::uint32_t owner,
                    double spacing = 0.004,
                    double noise = 0,
                    std::uint64_t seed = 1) {
    Random random(seed);
    const Eigen::Vector3d normal = a.cross(b).normalized();
    const int num_a = static_cast<int>(std::ceil(a.norm() / spacing));
    const int num_b = static_cast<int>(std::ceil(b.norm() / spacing));
    for (int i = 0; i < num_a; ++i) {
      for (int j = 0; j < num_b; ++j) {
        Add(corner + a * ((i + 0.5) / num_a) + b * ((j + 0.5) / num_b) +
                noise * random.Gaussian() * normal,
            normal, owner);
      }
    }
  }

  // Top and four sides of an upright box on z = corner.z.
  void AddBox(const Eigen::Vector3d& corner,
              const Eigen::Vector3d& size,
              std::uint32_t owner,
              double noise = 0) {
    const Eigen::Vector3d x(size.x(), 0, 0);
    const Eigen::Vector3d y(0, size.y(), 0);
    const Eigen::Vector3d z(0, 0, size.z());
    AddRectangle(corner + z, x, y, owner, 0.004, noise, 2);
    AddRectangle(corner, x, z, owner, 0.004, noise, 3);
    AddRectangle(corner + x, y, z, owner, 0.004, noise, 4);
    AddRectangle(corner + x + y, -x, z, owner, 0.004, noise, 5);
    AddRectangle(corner + y, -y, z, owner, 0.004, noise, 6);
  }

  void AddSphere(const Eigen::Vector3d& centre, double radius, std::uint32_t owner) {
    const int num_points = static_cast<int>(4 * 3.15 * radius * radius / (0.004 * 0.004));
    for (int i = 0; i < num_points; ++i) {  // Fibonacci lattice.
      const double z = 1 - 2 * (i + 0.5) / num_points;
      const double angle = i * 2.399963229728653;
      const double ring = std::sqrt(1 - z * z);
      const Eigen::Vector3d normal(ring * std::cos(angle), ring * std::sin(angle), z);
      Add(centre + radius * normal, normal, owner);
    }
  }

  SyntheticScene Transformed(const Rigid3& T) const {
    SyntheticScene scene = *this;
    for (Eigen::Vector3f& point : scene.points) point = (T * point.cast<double>()).cast<float>();
    for (Eigen::Vector3f& normal : scene.normals) {
      normal = (T.rotation * normal.cast<double>()).cast<float>();
    }
    return scene;
  }

  // scene.points[i] = points[order[i]].
  SyntheticScene Permuted(const std::vector<std::size_t>& order) const {
    SyntheticScene scene;
    for (const std::size_t i : order) {
      scene.points.push_back(points[i]);
      scene.normals.push_back(normals[i]);
      scene.truth.push_back(truth[i]);
    }
    return scene;
  }
};

inline std::vector<std::size_t> RandomOrder(std::size_t size, std::uint64_t seed) {
  std::vector<std::size_t> order(size);
  std::iota(order.begin(), order.end(), 0);
  Random random(seed);
  for (std::size_t i = size; i > 1; --i) {
    std::swap(order[i - 1], order[random.Index(static_cast<std::uint32_t>(i))]);
  }
  return order;
}

// A desk (1), a wall behind it (2), a box (3), a ball (4) and a flat thing of a keyboard's size (5)
// on the desk. A camera sees no desk under the things, so there is none.
inline SyntheticScene MakeDesk(double noise = 0) {
  SyntheticScene whole;
  whole.AddRectangle({0, 0, 0}, {1.2, 0, 0}, {0, 0.8, 0}, 1, 0.004, noise, 10);
  SyntheticScene scene;
  for (std::size_t i = 0; i < whole.points.size(); ++i) {
    const Eigen::Vector3d p = whole.points[i].cast<double>();
    const bool is_under_box = p.x() > 0.15 && p.x() < 0.35 && p.y() > 0.3 && p.y() < 0.45;
    const bool is_under_keyboard = p.x() > 0.6 && p.x() < 1.02 && p.y() > 0.1 && p.y() < 0.25;
    if (!is_under_box && !is_under_keyboard) scene.Add(p, Eigen::Vector3d::UnitZ(), 1);
  }
  scene.AddRectangle({0, 0.8, 0}, {1.2, 0, 0}, {0, 0, 0.6}, 2, 0.004, noise, 11);
  scene.AddBox({0.15, 0.3, 0}, {0.2, 0.15, 0.12}, 3, noise);
  scene.AddSphere({0.6, 0.5, 0.075}, 0.075, 4);
  scene.AddBox({0.6, 0.1, 0}, {0.42, 0.15, 0.03}, 5, noise);
  return scene;
}

}  // namespace semslam::test

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/light_buffer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "semslam/base/check.h"
#include "semslam/base/parallel.h"

namespace semslam {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kLift = 5e-4F;  // Metres by which a ray starts above its surface.
constexpr int kPattern = 4;     // Neighbours that share their rays: 4 x 4.

// The 16 points of a (4, 2) net, the rank given to each place of the pattern: neighbours differ
// much.
constexpr int kRank[kPattern][kPattern] = {
    {0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};

float VanDerCorput(int index) {  // Base 2, four bits.
  return static_cast<float>(((index & 1) << 3) | ((index & 2) << 1) | ((index & 4) >> 1) |
                            (index >> 3)) /
         16.0F;
}

Eigen::Vector2f PatternPoint(int column, int row) {
  const int rank = kRank[row & (kPattern - 1)][column & (kPattern - 1)];
  return {(static_cast<float>(rank) + 0.5F) / 16.0F, VanDerCorput(rank) + 0.5F / 16.0F};
}

Eigen::Vector2f OnDisc(const Eigen::Vector2f& square) {
  const float radius = std::sqrt(square.x());
  const float angle = 2.0F * kPi * square.y();
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

// A direction above the surface, with a density proportional to its cosine.
Eigen::Vector3f AboveSurface(const Eigen::Vector3f& normal, const Eigen::Vector2f& square) {
  const Eigen::Vector2f disc = OnDisc(square);
  const Eigen::Vector3f helper =
      std::abs(normal.z()) < 0.9F ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f::UnitX();
  const Eigen::Vector3f side = helper.cross(normal).normalized();
  return side * disc.x() + normal.cross(side) * disc.y() +
         normal * std::sqrt(std::max(0.0F, 1.0F - square.x()));
}

// 1 if light at b is light at a, too: both on one surface; falls to 0 where one has left the plane
// or the direction of the other.
float Affinity(const SurfacePoint& a, const SurfacePoint& b) {
  if (b.part == Hit::kNone) return 0;
  const float off_plane = std::abs(a.face_normal.dot(b.p_world - a.p_world));
  const float bend = 1.0F - a.normal.dot(b.normal);
  return std::max(0.0F, 1.0F - off_plane / (2.0F * a.footprint)) *
         std::max(0.0F, 1.0F - 4.0F * bend);
}

}  // namespace

LightBuffer::LightBuffer(const Scene& scene,
                         const RayScene& ray_scene,
                         std::span<const SurfacePoint> surface,
                         int width,
                         const Options& options)
    : scene_(scene),
      ray_scene_(ray_scene),
      surface_(surface),
      width_(width),
      num_columns_((width + 1) / 2),
      num_rows_((static_cast<int>(surface.size()) / width + 1) / 2),
      options_(options),
      sampled_(static_cast<std::size_t>(num_columns_) * num_rows_, Lighting::Ones()),
      filtered_(sampled_) {
  SEMSLAM_CHECK(scene.lights().size() <= kMaxLights) << "lights: " << scene.lights().size();
  if (!options_.shadows && options_.occlusion_reach <= 0) return;  // All light everywhere.
  const auto for_rows = [&](auto body) {
    ParallelFor(num_rows_, 4, options_.num_threads, [&](std::size_t first, std::size_t last) {
      for (std::size_t row = first; row < last; ++row) body(static_cast<int>(row));
    });
  };
  for_rows([this](int row) { SampleRow(row); });
  for_rows([this](int row) { FilterRow(row); });
}

void LightBuffer::SampleRow(int row) {
  std::vector<Ray> rays(static_cast<std::size_t>(num_columns_));
  std::vector<std::uint8_t> occluded(rays.size());
  const auto cast = [&](int channel, const auto& make_ray) {
    for (int column = 0; column < num_columns_; ++column) {
      const SurfacePoint& point = PointOf(column, row);
      Ray& ray = rays[column];
      ray = {Eigen::Vector3f::Zero(), Eigen::Vector3f::UnitZ(), 0.0F};
      if (point.part == Hit::kNone) continue;
      ray = make_ray(point, PatternPoint(column, row));
    }
    ray_scene_.Occluded(rays, occluded);
    for (int column = 0; column < num_columns_; ++column) {
      if (occluded[column] != 0)
        sampled_[static_cast<std::size_t>(row) * num_columns_ + column][channel] = 0;
    }
  };
  for (std::size_t i = 0; options_.shadows && i < scene_.lights().size(); ++i) {
    const Light& light = scene_.lights()[i];
    cast(static_cast<int>(i), [&](const SurfacePoint& point, const Eigen::Vector2f& square) -> Ray {
      const Eigen::Vector2f disc = light.radius * OnDisc(square);
      const Eigen::Vector3f origin = point.p_world + kLift * point.face_normal;
      return {origin, light.p_world + Eigen::Vector3f(disc.x(), disc.y(), 0) - origin, 1.0F};
    });
  }
  if (options_.occlusion_reach <= 0) return;
  cast(kMaxLights, [&](const SurfacePoint& point, const Eigen::Vector2f& square) -> Ray {
    return {point.p_world + kLift * point.face_normal, AboveSurface(point.face_normal, square),
            options_.occlusion_reach};
  });
}

void LightBuffer::FilterRow(int row) {
  for (int column = 0; column < num_columns_; ++column) {
    const SurfacePoint& center = PointOf(column, row);
    const std::size_t index = static_cast<std::size_t>(row) * num_columns_ + column;
    filtered_[index] = sampled_[index];
    if (center.part == Hit::kNone) continue;
    Lighting sum = Lighting::Zero();
    float total = 0;
    for (int y = std::max(0, row - 1); y < std::min(num_rows_, row + 3); ++y) {
      for (int x = std::max(0, column - 1); x < std::min(num_columns_, column + 3); ++x) {
        const float weight = Affinity(center, PointOf(x, y));
        sum += weight * sampled_[static_cast<std::size_t>(y) * num_columns_ + x];
        total += weight;
      }
    }
    filtered_[index] = sum / total;  // The centre's own weight is 1.
  }
}

Lighting LightBuffer::At(const SurfacePoint& point, int column, int row) const {
  if (!options_.shadows && options_.occlusion_reach <= 0) return Lighting::Ones();
  const int x0 = column / 2;
  const int y0 = row / 2;
  Lighting sum = Lighting::Zero();
  float total = 0;
  for (int dy = 0; dy <= (row & 1); ++dy) {
    for (int dx = 0; dx <= (column & 1); ++dx) {
      const int x = std::min(x0 + dx, num_columns_ - 1);
      const int y = std::min(y0 + dy, num_rows_ - 1);
      // A thin thing may have no sample of its own: then its neighbours' light must do.
      const float weight = Affinity(point, PointOf(x, y)) + 1e-4F;
      sum += weight * filtered_[static_cast<std::size_t>(y) * num_columns_ + x];
      total += weight;
    }
  }
  return sum / total;
}

}  // namespace semslam

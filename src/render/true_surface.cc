// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/true_surface.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>

#include "semslam/base/parallel.h"
#include "semslam/dense/voxel_index.h"
#include "semslam/io/cloud_io.h"

#include "render/ray_scene.h"
#include "render/surface.h"

namespace semslam {
namespace {

constexpr std::size_t kViewsAtOnce = 16;
constexpr double kMaxRate = 10;  // Frames a second: those between see nothing else.

struct Sample {
  std::uint64_t voxel = 0;
  std::uint32_t instance = 0;
  float to_center = 0;  // Of the voxel.
  Eigen::Vector3f position;
  Eigen::Vector3f normal;

  std::pair<std::uint64_t, std::uint32_t> Place() const { return {voxel, instance}; }
  auto Order() const {
    return std::tuple(voxel, instance, to_center, position.x(), position.y(), position.z());
  }
};

using Samples = std::vector<Sample>;

bool IsBefore(const Sample& a, const Sample& b) { return a.Order() < b.Order(); }

// Of sorted samples, leaves the best one of each place.
void KeepBest(Samples& samples) {
  samples.erase(
      std::unique(samples.begin(), samples.end(),
                  [](const Sample& a, const Sample& b) { return a.Place() == b.Place(); }),
      samples.end());
}

class Sampler {
 public:
  Sampler(const RenderedClip& clip, double spacing)
      : clip_(clip),
        spacing_(spacing),
        rays_(clip.camera()),
        ray_scene_(clip.scene(), RayScene::Edges::kTight),
        triangles_(clip.scene()),
        step_(std::max<std::size_t>(1, std::lround(clip.options().fps / kMaxRate))) {}

  // A clip's frames are more than are needed: every step-th is sampled.
  std::size_t num_views() const { return (clip_.num_frames() + step_ - 1) / step_; }

  // A quarter of the pixels of a frame, another one in each of four successive views.
  Samples SampleView(std::size_t view) const {
    const Rigid3 T_world_camera = clip_.T_world_camera(view * step_);
    Samples samples;
    RayBatch rays;
    rays.Resize(static_cast<std::size_t>(rays_.width() + 7) / 8 * 4);  // Every second pixel.
    HitBatch hits;
    SurfacePoints points;
    points.Resize(rays.size());
    for (int y = static_cast<int>(view / 2 % 2); y < rays_.height(); y += 2) {
      SetRays(T_world_camera, static_cast<int>(view % 2), y, rays);
      ray_scene_.Intersect(rays, &hits);
      triangles_.Locate(rays, hits, 0, 0, &points);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        if (const auto sample = ToSample(hits, points, i)) samples.push_back(*sample);
      }
    }
    std::sort(samples.begin(), samples.end(), IsBefore);
    KeepBest(samples);
    return samples;
  }

 private:
  // Through every second pixel of a row, from `first` on; their lengths are depths.
  void SetRays(const Rigid3& T_world_camera, int first, int row, RayBatch& rays) const {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const int x = first + 2 * static_cast<int>(i);
      rays.length[i] = -1.0F;
      if (x >= rays_.width()) continue;
      const Eigen::Vector2f& ray = rays_.At(x, row);
      const Eigen::Vector3d direction =
          T_world_camera.rotation * Eigen::Vector3d(ray.x(), ray.y(), 1.0);
      Set(T_world_camera.translation, i, rays.origin);
      Set(direction, i, rays.direction);
      rays.length[i] = static_cast<float>(clip_.options().depth.max_depth_m);
    }
  }

  static void Set(const Eigen::Vector3d& value, std::size_t index, VectorRow& row) {
    row.x[index] = static_cast<float>(value.x());
    row.y[index] = static_cast<float>(value.y());
    row.z[index] = static_cast<float>(value.z());
  }
  static Eigen::Vector3f Get(const VectorRow& row, std::size_t index) {
    return {row.x[index], row.y[index], row.z[index]};
  }

  std::optional<Sample> ToSample(const HitBatch& hits,
                                 const SurfacePoints& points,
                                 std::size_t index) const {
    const DepthSensorOptions& sensor = clip_.options().depth;
    if (hits.part[index] == Hit::kNone ||
        hits.distance[index] < static_cast<float>(sensor.min_depth_m) ||
        points.incidence[index] < static_cast<float>(sensor.min_incidence)) {
      return std::nullopt;
    }
    const Eigen::Vector3f p_world = Get(points.p_world, index);
    const auto voxel = VoxelKey::Coordinates(p_world.cast<double>(), spacing_);
    if (!voxel) return std::nullopt;
    const Eigen::Vector3d center = spacing_ * (voxel->cast<double>().array() + 0.5).matrix();
    return Sample{VoxelKey::Pack(*voxel), clip_.scene().parts()[hits.part[index]].instance_id,
                  (p_world - center.cast<float>()).norm(), p_world, Get(points.face_normal, index)};
  }

  const RenderedClip& clip_;
  double spacing_;
  RayTable rays_;
  RayScene ray_scene_;
  TriangleTable triangles_;
  std::size_t step_;
};

Samples Merged(const Samples& a, const Samples& b) {
  Samples all;
  all.reserve(a.size() + b.size());
  std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all), IsBefore);
  KeepBest(all);
  return all;
}

}  // namespace

TrueSurface SampleTrueSurface(const RenderedClip& clip, double spacing) {
  const Sampler sampler(clip, spacing);
  Samples all;
  for (std::size_t first = 0; first < sampler.num_views(); first += kViewsAtOnce) {
    std::vector<Samples> views(std::min(kViewsAtOnce, sampler.num_views() - first));
    ParallelFor(views.size(), 1, clip.options().num_threads,
                [&](std::size_t begin, std::size_t end) {
                  for (std::size_t i = begin; i < end; ++i)
                    views[i] = sampler.SampleView(first + i);
                });
    Samples batch;
    for (const Samples& view : views) batch = Merged(batch, view);
    all = Merged(all, batch);
  }
  TrueSurface surface;
  for (const Sample& sample : all) {
    surface.positions.push_back(sample.position);
    surface.normals.push_back(sample.normal);
    surface.instances.push_back(sample.instance);
  }
  return surface;
}

void WriteTrueSurface(const std::filesystem::path& path, const TrueSurface& surface) {
  WritePcd(
      path,
      {.positions = surface.positions, .normals = surface.normals, .labels = surface.instances});
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/true_surface.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>

#include "semslam/base/parallel.h"
#include "semslam/dense/voxel_index.h"
#include "semslam/io/cloud_io.h"

#include "render/ray_scene.h"
#include "render/shading.h"

namespace semslam {
namespace {

constexpr std::size_t kFramesAtOnce = 16;

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
      : clip_(clip), spacing_(spacing), rays_(clip.camera()), ray_scene_(clip.scene()) {}

  // A quarter of the frame's pixels, another one in each of four successive frames.
  Samples SampleFrame(std::size_t frame) const {
    const Rigid3 T_world_camera = clip_.T_world_camera(frame);
    Samples samples;
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    for (int y = static_cast<int>(frame / 2 % 2); y < rays_.height(); y += 2) {
      rays.clear();
      for (int x = static_cast<int>(frame % 2); x < rays_.width(); x += 2) {
        rays.push_back(CameraRay(T_world_camera, rays_.At(x, y)));
      }
      hits.resize(rays.size());
      ray_scene_.Intersect(rays, hits);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        if (const auto sample = ToSample(rays[i], hits[i])) samples.push_back(*sample);
      }
    }
    std::sort(samples.begin(), samples.end(), IsBefore);
    KeepBest(samples);
    return samples;
  }

 private:
  // Its lengths are depths.
  Ray CameraRay(const Rigid3& T_world_camera, const Eigen::Vector2f& ray) const {
    const Eigen::Vector3d direction(ray.x(), ray.y(), 1.0);
    return {T_world_camera.translation.cast<float>(),
            (T_world_camera.rotation * direction).cast<float>(),
            static_cast<float>(clip_.options().depth.max_depth_m)};
  }

  std::optional<Sample> ToSample(const Ray& ray, const Hit& hit) const {
    const SurfacePoint point = LocateHit(clip_.scene(), hit, ray, 0);
    const DepthSensorOptions& sensor = clip_.options().depth;
    if (point.part == Hit::kNone || hit.distance < static_cast<float>(sensor.min_depth_m) ||
        point.incidence < static_cast<float>(sensor.min_incidence)) {
      return std::nullopt;
    }
    const auto voxel = VoxelKey::Coordinates(point.p_world.cast<double>(), spacing_);
    if (!voxel) return std::nullopt;
    const Eigen::Vector3d center = spacing_ * (voxel->cast<double>().array() + 0.5).matrix();
    return Sample{VoxelKey::Pack(*voxel), clip_.scene().parts()[point.part].instance_id,
                  (point.p_world - center.cast<float>()).norm(), point.p_world, point.face_normal};
  }

  const RenderedClip& clip_;
  double spacing_;
  RayTable rays_;
  RayScene ray_scene_;
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
  for (std::size_t first = 0; first < clip.num_frames(); first += kFramesAtOnce) {
    std::vector<Samples> frames(std::min(kFramesAtOnce, clip.num_frames() - first));
    ParallelFor(frames.size(), 1, clip.options().num_threads,
                [&](std::size_t begin, std::size_t end) {
                  for (std::size_t i = begin; i < end; ++i)
                    frames[i] = sampler.SampleFrame(first + i);
                });
    Samples batch;
    for (const Samples& frame : frames) batch = Merged(batch, frame);
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

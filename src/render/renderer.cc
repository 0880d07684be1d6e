// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "semslam/base/parallel.h"

#include "render/light_buffer.h"
#include "render/ray_scene.h"
#include "render/shading.h"

namespace semslam {
namespace {

constexpr std::size_t kRowsPerChunk = 8;
constexpr float kFar = 1e4F;  // Metres: farther than any scene.

// The camera's rays, in world coordinates.
struct View {
  const RayTable& rays;
  Eigen::Vector3d p_world_camera;
  Eigen::Matrix3d R_world_camera;
  float pixel_angle;  // Radians a pixel covers.
};

Eigen::Vector3d WorldDirection(const View& view, const Eigen::Vector2f& ray) {
  return view.R_world_camera * Eigen::Vector3d(ray.x(), ray.y(), 1.0);
}

// In the middle of the picture.
float PixelAngle(const RayTable& rays) {
  const int column = rays.width() / 2;
  const int row = rays.height() / 2;
  return (rays.At(column, row) - rays.At(column - 1, row)).norm();
}

// A ray whose lengths are depths.
Ray CameraRay(const View& view, const Eigen::Vector2f& ray) {
  return {view.p_world_camera.cast<float>(), WorldDirection(view, ray).cast<float>(), kFar};
}

// Depth at which the ray meets the plane of the triangle, in double precision, so that the truth
// does not carry the ray caster's rounding.
double ExactDepth(const TriangleMesh& mesh,
                  const Hit& hit,
                  const View& view,
                  const Eigen::Vector2f& ray) {
  const Eigen::Vector3i& corners = mesh.triangles[hit.triangle];
  const Eigen::Vector3d a = mesh.positions[corners[0]].cast<double>();
  const Eigen::Vector3d b = mesh.positions[corners[1]].cast<double>();
  const Eigen::Vector3d c = mesh.positions[corners[2]].cast<double>();
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const double slope = normal.dot(WorldDirection(view, ray));
  if (std::abs(slope) <= 1e-6 * normal.norm()) return hit.distance;  // Seen edge on.
  return normal.dot(a - view.p_world_camera) / slope;
}

// True if an edge that shows runs between two neighbouring pixels.
bool IsEdge(const SurfacePoint& a, const SurfacePoint& b) {
  if (a.part != b.part) return true;
  if (a.part == Hit::kNone) return false;
  if (a.normal.dot(b.normal) < 0.9F) return true;
  const float step = std::abs(a.face_normal.dot(b.p_world - a.p_world));
  return step > 3.0F * a.footprint;
}

}  // namespace

class Renderer::Impl {
 public:
  Impl(const Scene& scene, const Options& options)
      : scene_(scene), options_(options), ray_scene_(scene) {}

  IdealImage Render(const RayTable& rays, const Rigid3& T_world_camera, int num_threads) const {
    const View view = {rays, T_world_camera.translation, T_world_camera.rotation.toRotationMatrix(),
                       PixelAngle(rays)};
    const cv::Size size(rays.width(), rays.height());
    IdealImage image;
    image.radiance.create(size, CV_32FC3);
    image.depth.create(size, CV_64FC1);
    image.labels.create(size, CV_16UC1);
    image.incidence.create(size, CV_32FC1);
    std::vector<SurfacePoint> surface(static_cast<std::size_t>(size.area()));
    ForRows(size.height, num_threads, [&](int row) { TraceRow(view, row, surface, &image); });
    const LightBuffer light(scene_, ray_scene_, surface, size.width, LightOptions(num_threads));
    ForRows(size.height, num_threads,
            [&](int row) { ShadeRow(view, row, surface, light, &image); });
    return image;
  }

 private:
  LightBuffer::Options LightOptions(int num_threads) const {
    return {options_.shadows, static_cast<float>(options_.occlusion_reach), num_threads};
  }

  template <typename Body>
  static void ForRows(int num_rows, int num_threads, const Body& body) {
    ParallelFor(num_rows, kRowsPerChunk, num_threads, [&](std::size_t first, std::size_t last) {
      for (std::size_t row = first; row < last; ++row) body(static_cast<int>(row));
    });
  }

  // Fills one row of surface points, depth, labels and incidence.
  void TraceRow(const View& view,
                int row,
                std::vector<SurfacePoint>& surface,
                IdealImage* image) const {
    const int width = view.rays.width();
    std::vector<Ray> rays(static_cast<std::size_t>(width));
    std::vector<Hit> hits(rays.size());
    for (int x = 0; x < width; ++x) rays[x] = CameraRay(view, view.rays.At(x, row));
    ray_scene_.Intersect(rays, hits);
    for (int x = 0; x < width; ++x) {
      SurfacePoint& point = surface[static_cast<std::size_t>(row) * width + x];
      point = LocateHit(scene_, hits[x], rays[x], view.pixel_angle);
      const bool is_hit = point.part != Hit::kNone;
      image->depth.at<double>(row, x) =
          is_hit ? ExactDepth(scene_.parts()[point.part].mesh, hits[x], view, view.rays.At(x, row))
                 : 0.0;
      image->labels.at<std::uint16_t>(row, x) = is_hit ? scene_.parts()[point.part].instance_id : 0;
      image->incidence.at<float>(row, x) = point.incidence;
    }
  }

  // Colours one row; pixels that an edge crosses get the mean of their centre and four points more.
  void ShadeRow(const View& view,
                int row,
                const std::vector<SurfacePoint>& surface,
                const LightBuffer& light,
                IdealImage* image) const {
    const Eigen::Vector3f eye = view.p_world_camera.cast<float>();
    const int width = view.rays.width();
    std::vector<int> edge_columns;
    for (int x = 0; x < width; ++x) {
      const SurfacePoint& point = surface[static_cast<std::size_t>(row) * width + x];
      const Eigen::Vector3f color = Shade(scene_, point, eye, light.At(point, x, row));
      image->radiance.at<cv::Vec3f>(row, x) = {color.x(), color.y(), color.z()};
      if (options_.smooth_edges && TouchesEdge(surface, x, row, width)) edge_columns.push_back(x);
    }
    SmoothPixels(view, row, edge_columns, light, image);
  }

  static bool TouchesEdge(const std::vector<SurfacePoint>& surface, int x, int y, int width) {
    const std::size_t index = static_cast<std::size_t>(y) * width + x;
    const SurfacePoint& point = surface[index];
    if (x > 0 && IsEdge(point, surface[index - 1])) return true;
    if (x + 1 < width && IsEdge(point, surface[index + 1])) return true;
    if (y > 0 && IsEdge(point, surface[index - width])) return true;
    return index + width < surface.size() && IsEdge(point, surface[index + width]);
  }

  void SmoothPixels(const View& view,
                    int row,
                    const std::vector<int>& columns,
                    const LightBuffer& light,
                    IdealImage* image) const {
    constexpr int kSamples = 4;
    // A rotated square: every sample has a column and a row of its own.
    constexpr std::array<std::array<float, 2>, kSamples> kOffsets = {
        {{-0.125F, -0.375F}, {0.375F, -0.125F}, {0.125F, 0.375F}, {-0.375F, 0.125F}}};
    const int width = view.rays.width();
    std::vector<Ray> rays;
    rays.reserve(columns.size() * kSamples);
    for (const int x : columns) {
      const Eigen::Vector2f center = view.rays.At(x, row);
      const Eigen::Vector2f step_x =
          x + 1 < width ? view.rays.At(x + 1, row) - center : center - view.rays.At(x - 1, row);
      const Eigen::Vector2f step_y(-step_x.y(), step_x.x());
      for (const auto& [dx, dy] : kOffsets) {
        rays.push_back(CameraRay(view, center + dx * step_x + dy * step_y));
      }
    }
    std::vector<Hit> hits(rays.size());
    ray_scene_.Intersect(rays, hits);
    const Eigen::Vector3f eye = view.p_world_camera.cast<float>();
    for (std::size_t i = 0; i < columns.size(); ++i) {
      auto& color = image->radiance.at<cv::Vec3f>(row, columns[i]);
      for (std::size_t k = i * kSamples; k < (i + 1) * kSamples; ++k) {
        const SurfacePoint point = LocateHit(scene_, hits[k], rays[k], view.pixel_angle);
        const Eigen::Vector3f sample = Shade(scene_, point, eye, light.At(point, columns[i], row));
        color += cv::Vec3f(sample.x(), sample.y(), sample.z());
      }
      color *= 1.0F / (kSamples + 1);
    }
  }

  const Scene& scene_;
  Options options_;
  RayScene ray_scene_;
};

Renderer::Renderer(const Scene& scene, const Options& options)
    : impl_(std::make_unique<const Impl>(scene, options)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

IdealImage Renderer::Render(const RayTable& rays,
                            const Rigid3& T_world_camera,
                            int num_threads) const {
  return impl_->Render(rays, T_world_camera, num_threads);
}

}  // namespace semslam

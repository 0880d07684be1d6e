// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "semslam/base/guarded.h"
#include "semslam/base/parallel.h"

#include "render/light_buffer.h"
#include "render/ray_scene.h"
#include "render/shading.h"
#include "render/surface.h"

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
  int stride;         // Pixels from row to row of the surface points: the width or a little more.
};

// In the middle of the picture.
float PixelAngle(const RayTable& rays) {
  const int column = rays.width() / 2;
  const int row = rays.height() / 2;
  return (rays.At(column, row) - rays.At(column - 1, row)).norm();
}

// Turns directions in the camera's frame (x / z, y / z) into rays whose lengths are depths.
class CameraRays {
 public:
  CameraRays(const View& view, std::size_t size)
      : R_world_camera_(view.R_world_camera.cast<float>()) {
    batch_.Resize(size);
    const Eigen::Vector3f eye = view.p_world_camera.cast<float>();
    for (std::size_t i = 0; i < size; i += 4) {
      batch_.origin.Set(i, {eye.x(), eye.y(), eye.z()});
      batch_.length.Set(i, kFar);
    }
  }
  void Set(std::size_t index, const Eigen::Vector2f& ray) {
    const Eigen::Vector3f direction = R_world_camera_.col(0) * ray.x() +
                                      R_world_camera_.col(1) * ray.y() + R_world_camera_.col(2);
    batch_.direction.x[index] = direction.x();
    batch_.direction.y[index] = direction.y();
    batch_.direction.z[index] = direction.z();
  }
  // As of RayBatch.
  void SetRowLength(std::size_t row_length) { batch_.row_length = row_length; }
  const RayBatch& batch() const { return batch_; }

 private:
  Eigen::Matrix3f R_world_camera_;
  RayBatch batch_;
};

// Depth at which rays meet the plane of a triangle, in double precision, so that the truth does not
// carry the ray caster's rounding. Neighbouring pixels mostly see one triangle, whose plane is
// kept.
class ExactDepth {
 public:
  ExactDepth(const Scene& scene, const View& view) : scene_(scene), view_(view) {}

  double At(std::uint32_t part,
            std::uint32_t triangle,
            const Eigen::Vector2f& ray,
            float approximate_depth) {
    if (part != part_ || triangle != triangle_) SetPlane(part, triangle);
    const double slope = normal_camera_.dot(Eigen::Vector3d(ray.x(), ray.y(), 1.0));
    if (std::abs(slope) <= min_slope_) return approximate_depth;  // Seen edge on.
    return offset_ / slope;
  }

 private:
  void SetPlane(std::uint32_t part, std::uint32_t triangle) {
    part_ = part;
    triangle_ = triangle;
    const TriangleMesh& mesh = scene_.parts()[part].mesh;
    const Eigen::Vector3i& corners = mesh.triangles[triangle];
    const Eigen::Vector3d a = mesh.positions[corners[0]].cast<double>();
    const Eigen::Vector3d b = mesh.positions[corners[1]].cast<double>();
    const Eigen::Vector3d c = mesh.positions[corners[2]].cast<double>();
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    normal_camera_ = view_.R_world_camera.transpose() * normal;
    offset_ = normal.dot(a - view_.p_world_camera);
    min_slope_ = 1e-6 * normal.norm();
  }

  const Scene& scene_;
  const View& view_;
  std::uint32_t part_ = Hit::kNone;
  std::uint32_t triangle_ = 0;
  Eigen::Vector3d normal_camera_ = Eigen::Vector3d::Zero();
  double offset_ = 0;
  double min_slope_ = 0;
};

// One bit for each of four pixels from index `a` on: an edge that shows runs between it and its
// neighbour, from index `b` on.
int EdgeBits(const SurfacePoints& points, std::size_t a, std::size_t b) {
  const auto parts = [&](std::size_t index) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(points.part.data() + index));
  };
  const int same = _mm_movemask_ps(_mm_castsi128_ps(_mm_cmpeq_epi32(parts(a), parts(b))));
  const Vector4 normal = points.normal.At(a);
  const Float4 step =
      Abs(Dot(points.face_normal.At(a), points.p_world.At(b) - points.p_world.At(a)));
  return (~same & 0xf) |
         LessBits(Dot(normal, points.normal.At(b)), Float4(0.9F) * Dot(normal, normal)) |
         LessBits(Float4(3.0F) * points.footprint.At(a), step);
}

// True if a pixel looks different from one of its neighbours: else smoothing would not show.
bool HasContrast(const cv::Mat& radiance, int column, int row) {
  constexpr float kLevel = 12.0F / 255.0F;  // Of gamma-coded colour: a step that noise hides.
  const auto& center = radiance.ptr<cv::Vec3f>(row)[column];
  for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
    const int x = std::clamp(column + dx, 0, radiance.cols - 1);
    const int y = std::clamp(row + dy, 0, radiance.rows - 1);
    const auto& other = radiance.ptr<cv::Vec3f>(y)[x];
    for (int k = 0; k < 3; ++k) {
      // Levels are square roots: their difference is that of light over their sum.
      const float difference = center[k] - other[k];
      if (difference * difference > 4.0F * kLevel * kLevel * std::max(center[k], other[k]))
        return true;
    }
  }
  return false;
}

void SetColor(const Vector4& color, int count, cv::Vec3f* pixels) {
  std::array<std::array<float, 4>, 3> channels;
  color.x.Store(channels[0].data());
  color.y.Store(channels[1].data());
  color.z.Store(channels[2].data());
  for (int i = 0; i < count; ++i) pixels[i] = {channels[0][i], channels[1][i], channels[2][i]};
}

// Memory that one picture needs, and the next one again.
struct Workspace {
  SurfacePoints points;
  LightBuffer light;
};

}  // namespace

class Renderer::Impl {
 public:
  Impl(const Scene& scene, const Options& options)
      : scene_(scene),
        options_(options),
        ray_scene_(scene, RayScene::Edges::kTight),
        fast_ray_scene_(scene, RayScene::Edges::kFast),
        triangles_(scene) {}

  IdealImage Render(const RayTable& rays, const Rigid3& T_world_camera, int num_threads) const {
    const View view = {rays, T_world_camera.translation, T_world_camera.rotation.toRotationMatrix(),
                       PixelAngle(rays), (rays.width() + 3) / 4 * 4};
    const cv::Size size(rays.width(), rays.height());
    IdealImage image;
    image.radiance.create(size, CV_32FC3);
    image.depth.create(size, CV_64FC1);
    image.labels.create(size, CV_16UC1);
    image.incidence.create(size, CV_32FC1);
    std::unique_ptr<Workspace> workspace = TakeWorkspace();
    SurfacePoints& points = workspace->points;
    points.Resize(static_cast<std::size_t>(view.stride) * size.height);
    ForRows((size.height + 1) / 2, num_threads,
            [&](int pair) { TracePair(view, pair, points, &image); });
    workspace->light.Fill(scene_, fast_ray_scene_, {points, size.width, size.height, view.stride},
                          {options_.shadows, static_cast<float>(options_.occlusion_reach)},
                          num_threads);
    ForRows(size.height, num_threads, [&](int row) { ShadeRow(view, row, *workspace, &image); });
    if (options_.smooth_edges) SmoothEdges(view, *workspace, num_threads, &image.radiance);
    idle_.Write([&](auto& idle) { idle.push_back(std::move(workspace)); });
    return image;
  }

 private:
  template <typename Body>
  static void ForRows(int num_rows, int num_threads, const Body& body) {
    ParallelFor(num_rows, kRowsPerChunk, num_threads, [&](std::size_t first, std::size_t last) {
      for (std::size_t row = first; row < last; ++row) body(static_cast<int>(row));
    });
  }

  std::unique_ptr<Workspace> TakeWorkspace() const {
    return idle_.Write([](auto& idle) {
      if (idle.empty()) return std::make_unique<Workspace>();
      std::unique_ptr<Workspace> workspace = std::move(idle.back());
      idle.pop_back();
      return workspace;
    });
  }

  // Fills a pair of rows of surface points, depth, labels and incidence.
  void TracePair(const View& view, int pair, SurfacePoints& points, IdealImage* image) const {
    const int width = view.rays.width();
    const int first_row = 2 * pair;
    const int num_rows = std::min(2, view.rays.height() - first_row);
    const std::size_t stride = view.stride;
    CameraRays rays(view, num_rows * stride);
    for (int i = 0; i < num_rows; ++i) {
      for (int x = 0; x < view.stride; ++x)
        rays.Set(i * stride + x, view.rays.At(std::min(x, width - 1), first_row + i));
    }
    if (num_rows == 2) rays.SetRowLength(stride);
    HitBatch hits;
    ray_scene_.Intersect(rays.batch(), &hits);
    triangles_.Locate(rays.batch(), hits, view.pixel_angle, first_row * stride, &points);
    for (int i = 0; i < num_rows; ++i)
      SetTruth(view, first_row + i, hits, i * stride, points, image);
  }

  // Depth, labels and incidence of a row, whose hits start at an index.
  void SetTruth(const View& view,
                int row,
                const HitBatch& hits,
                std::size_t index,
                const SurfacePoints& points,
                IdealImage* image) const {
    ExactDepth exact(scene_, view);
    const std::size_t first = static_cast<std::size_t>(row) * view.stride;
    for (int x = 0; x < view.rays.width(); ++x, ++index) {
      const std::uint32_t part = hits.part[index];
      const bool is_hit = part != Hit::kNone;
      image->depth.at<double>(row, x) =
          is_hit ? exact.At(part, hits.triangle[index], view.rays.At(x, row), hits.distance[index])
                 : 0.0;
      image->labels.at<std::uint16_t>(row, x) = is_hit ? scene_.parts()[part].instance_id : 0;
      image->incidence.at<float>(row, x) = points.incidence[first + x];
    }
  }

  void ShadeRow(const View& view, int row, const Workspace& workspace, IdealImage* image) const {
    const Eigen::Vector3f eye = view.p_world_camera.cast<float>();
    const int width = view.rays.width();
    const std::size_t first = static_cast<std::size_t>(row) * view.stride;
    auto* pixels = image->radiance.ptr<cv::Vec3f>(row);
    for (int x = 0; x < width; x += 4) {
      const Lighting light = workspace.light.AtPixels(workspace.points, first + x, x, row);
      SetColor(Shade(scene_, workspace.points, first + x, eye, light), std::min(4, width - x),
               pixels + x);
    }
  }

  // Pixels that an edge crosses get the mean of their centre and two points more.
  void SmoothEdges(const View& view,
                   const Workspace& workspace,
                   int num_threads,
                   cv::Mat* radiance) const {
    std::vector<std::vector<int>> columns(static_cast<std::size_t>(radiance->rows));
    ForRows(radiance->rows, num_threads, [&](int row) {
      for (const int column : EdgeColumns(view, row, workspace.points)) {
        if (HasContrast(*radiance, column, row)) columns[row].push_back(column);
      }
    });
    constexpr int kBand = 4;  // Rows whose pixels are smoothed together.
    ForRows((radiance->rows + kBand - 1) / kBand, num_threads, [&](int band) {
      std::vector<cv::Point> pixels;
      for (int row = kBand * band; row < std::min(kBand * (band + 1), radiance->rows); ++row) {
        for (const int column : columns[row]) pixels.emplace_back(column, row);
      }
      // So that neighbours on upright edges are cast together, too.
      std::stable_sort(pixels.begin(), pixels.end(),
                       [](const cv::Point& a, const cv::Point& b) { return a.x < b.x; });
      SmoothPixels(view, std::move(pixels), workspace.light, radiance);
    });
  }

  // The pixels of a row beside an edge.
  static std::vector<int> EdgeColumns(const View& view, int row, const SurfacePoints& points) {
    const int width = view.rays.width();
    const std::size_t stride = view.stride;
    const std::size_t first = row * stride;
    std::vector<int> columns;
    for (int x = 0; x < width; x += 4) {
      const std::size_t index = first + x;
      int bits = EdgeBits(points, index, index + 1);
      if (x + 4 >= width) bits &= (1 << (width - 1 - x)) - 1;  // Nothing right of the last column.
      // Each pixel is compared with its left neighbour, too: an edge has two sides.
      if (x > 0) {
        bits |= EdgeBits(points, index, index - 1);
      } else {
        bits |= EdgeBits(points, index + 1, index) << 1;
      }
      if (row > 0) bits |= EdgeBits(points, index, index - stride);
      if (row + 1 < view.rays.height()) bits |= EdgeBits(points, index, index + stride);
      for (int lane = 0; lane < std::min(4, width - x); ++lane) {
        if ((bits >> lane & 1) != 0) columns.push_back(x + lane);
      }
    }
    return columns;
  }

  // Four points, of two pixels, are computed together.
  void SmoothPixels(const View& view,
                    std::vector<cv::Point> pixels,
                    const LightBuffer& light,
                    cv::Mat* radiance) const {
    constexpr std::size_t kSamples = 2;
    constexpr std::array<std::array<float, 2>, kSamples> kOffsets = {
        {{-0.35F, -0.2F}, {0.35F, 0.2F}}};
    if (pixels.empty()) return;
    const std::size_t num_pixels = pixels.size();
    if (num_pixels % 2 != 0) pixels.push_back(pixels.back());
    CameraRays rays(view, pixels.size() * kSamples);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const auto [x, y] = pixels[i];
      const Eigen::Vector2f center = view.rays.At(x, y);
      const Eigen::Vector2f step_x = x + 1 < view.rays.width() ? view.rays.At(x + 1, y) - center
                                                               : center - view.rays.At(x - 1, y);
      const Eigen::Vector2f step_y(-step_x.y(), step_x.x());
      for (std::size_t k = 0; k < kSamples; ++k) {
        rays.Set(i * kSamples + k, center + kOffsets[k][0] * step_x + kOffsets[k][1] * step_y);
      }
    }
    HitBatch hits;
    fast_ray_scene_.Intersect(rays.batch(), &hits);
    SurfacePoints points;
    points.Resize(rays.batch().size());
    triangles_.Locate(rays.batch(), hits, view.pixel_angle, 0, &points);
    const Eigen::Vector3f eye = view.p_world_camera.cast<float>();
    for (std::size_t i = 0; i < num_pixels; i += 2) {
      std::array<cv::Vec3f, 2 * kSamples> samples;
      const cv::Point& a = pixels[i];
      const cv::Point& b = pixels[i + 1];
      const Lighting arriving =
          light.NearPixels(points, i * kSamples, {a.x, a.x, b.x, b.x}, {a.y, a.y, b.y, b.y});
      SetColor(Shade(scene_, points, i * kSamples, eye, arriving), 2 * kSamples, samples.data());
      const auto smooth = [&](const cv::Point& pixel, std::size_t first) {
        auto& color = radiance->at<cv::Vec3f>(pixel);
        color = (color + samples[first] + samples[first + 1]) * (1.0F / (kSamples + 1));
      };
      smooth(a, 0);
      if (i + 1 < num_pixels) smooth(b, kSamples);
    }
  }

  const Scene& scene_;
  Options options_;
  RayScene ray_scene_;       // For what is truth.
  RayScene fast_ray_scene_;  // For what only adds to colour.
  TriangleTable triangles_;
  mutable Guarded<std::vector<std::unique_ptr<Workspace>>> idle_;
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

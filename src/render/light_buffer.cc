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

// Points of the unit disc for four neighbours of a row of the pattern.
struct DiscPoints {
  Float4 x;
  Float4 y;
  Float4 height;  // Of the half sphere above.
};

DiscPoints PatternRow(int row) {
  float x[kPattern];
  float y[kPattern];
  float height[kPattern];
  for (int column = 0; column < kPattern; ++column) {
    const int rank = kRank[row & (kPattern - 1)][column];
    const float squared_radius = (static_cast<float>(rank) + 0.5F) / 16.0F;
    const float angle = 2.0F * kPi * (VanDerCorput(rank) + 0.5F / 16.0F);
    x[column] = std::sqrt(squared_radius) * std::cos(angle);
    y[column] = std::sqrt(squared_radius) * std::sin(angle);
    height[column] = std::sqrt(1.0F - squared_radius);
  }
  return {Float4::Load(x), Float4::Load(y), Float4::Load(height)};
}

// A direction above the surface, with a density proportional to its cosine. The axes beside the
// normal: Duff et al., "Building an Orthonormal Basis, Revisited", 2017.
Vector4 AboveSurface(const Vector4& normal, const DiscPoints& disc) {
  const Float4 sign = SignOf(normal.z);
  const Float4 a = Float4(-1.0F) / (sign + normal.z);
  const Float4 b = normal.x * normal.y * a;
  const Vector4 side = {Float4(1.0F) + sign * normal.x * normal.x * a, sign * b,
                        Float4(-1.0F) * sign * normal.x};
  const Vector4 other = {b, sign + normal.y * normal.y * a, Float4(-1.0F) * normal.y};
  return disc.x * side + disc.y * other + disc.height * normal;
}

// Four points as Affinity needs them.
struct Place {
  Vector4 p_world;
  Vector4 face_normal;
  Vector4 normal;
  Float4 footprint;
};

// 1 if light at b is light at a, too: both on one surface; falls to 0 where one has left the plane
// or the direction of the other. 0 if there is nothing at b.
Float4 Affinity(const Place& a, const Vector4& p_world_b, const Vector4& normal_b) {
  constexpr float kTiny = 1e-9F;  // Metres: nothing is seen at a.
  const Float4 off_plane = Abs(Dot(a.face_normal, p_world_b - a.p_world));
  const Float4 bend = Float4(1.0F) - Dot(a.normal, normal_b);
  return Max(Float4(1.0F) - off_plane / Max(Float4(2.0F) * a.footprint, kTiny), 0.0F) *
         Max(Float4(1.0F) - Float4(4.0F) * bend, 0.0F);
}

Place PlaceOf(const SurfacePoints& points, std::size_t index) {
  return {points.p_world.At(index), points.face_normal.At(index), points.normal.At(index),
          points.footprint.At(index)};
}

// A weighted mean of light.
class Mean {
 public:
  void Add(Float4 weight, const Lighting& lighting) {
    for (std::size_t i = 0; i < lighting.size(); ++i) sum_[i] += weight * lighting[i];
    total_ += weight;
  }
  Lighting Value() const {
    Lighting result;
    const Float4 factor = Float4(1.0F) / total_;
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = factor * sum_[i];
    return result;
  }

 private:
  Lighting sum_;
  Float4 total_;
};

// A thin thing may have no sample of its own: then its neighbours' light must do.
constexpr float kMinWeight = 1e-4F;

Lighting FullLight() {
  Lighting result;
  result.fill(1.0F);
  return result;
}

// The samples that pixels x to x + 3 of a row lie on or between, of samples x / 2 on.
Float4 LeftSamples(Float4 samples) {  // 0 0 1 1
  return Float4(_mm_unpacklo_ps(samples.lanes, samples.lanes));
}
Float4 RightSamples(Float4 samples) {  // 0 1 1 2
  return Float4(_mm_shuffle_ps(samples.lanes, samples.lanes, _MM_SHUFFLE(2, 1, 1, 0)));
}

}  // namespace

struct LightBuffer::Casting {
  const Scene& scene;
  const RayScene& ray_scene;
  const Options& options;
};

void LightBuffer::Fill(const Scene& scene,
                       const RayScene& ray_scene,
                       const Picture& picture,
                       const Options& options,
                       int num_threads) {
  SEMSLAM_CHECK(scene.lights().size() <= kMaxLights) << "lights: " << scene.lights().size();
  is_even_ = !options.shadows && options.occlusion_reach <= 0;
  if (is_even_) return;
  Resize(picture);
  const Casting casting = {scene, ray_scene, options};
  const auto for_rows = [&](auto body) {
    ParallelFor(num_rows_, 4, num_threads, [&](std::size_t first, std::size_t last) {
      for (std::size_t row = first; row < last; ++row) body(static_cast<int>(row));
    });
  };
  for_rows([&](int row) {
    CopyRow(picture, row);
    SampleRow(casting, row);
  });
  for_rows([&](int row) { FilterRow(row); });
}

void LightBuffer::Resize(const Picture& picture) {
  num_columns_ = (picture.width + 1) / 2;
  num_rows_ = (picture.height + 1) / 2;
  stride_ = (num_columns_ + 3) / 4 * 4 + 2 * kMargin;
  const std::size_t size = static_cast<std::size_t>(stride_) * num_rows_;
  for (VectorRow* row : {&p_world_, &face_normal_, &normal_}) row->Resize(size);
  footprint_.Resize(size);
  for (std::size_t i = 0; i <= kMaxLights; ++i) {
    sampled_[i].Resize(size);
    filtered_[i].Resize(size);
  }
}

void LightBuffer::CopyRow(const Picture& picture, int row) {
  const std::size_t first = static_cast<std::size_t>(2 * row) * picture.stride;
  const auto copy = [&](const FloatRow& from, FloatRow& to) {
    const std::size_t begin = IndexOf(-kMargin, row);
    std::fill_n(to.data() + begin, kMargin, 0.0F);
    for (int column = 0; column < num_columns_; ++column)
      to[IndexOf(column, row)] = from[first + 2 * static_cast<std::size_t>(column)];
    std::fill(to.data() + IndexOf(num_columns_, row), to.data() + begin + stride_, 0.0F);
  };
  const auto copy_vectors = [&](const VectorRow& from, VectorRow& to) {
    copy(from.x, to.x);
    copy(from.y, to.y);
    copy(from.z, to.z);
  };
  copy_vectors(picture.points.p_world, p_world_);
  copy_vectors(picture.points.face_normal, face_normal_);
  copy_vectors(picture.points.normal, normal_);
  copy(picture.points.footprint, footprint_);
}

void LightBuffer::SampleRow(const Casting& casting, int row) {
  const DiscPoints disc = PatternRow(row);
  const std::size_t first = IndexOf(0, row);
  RayBatch rays;
  FloatRow visible;
  rays.Resize(static_cast<std::size_t>(num_columns_ + 3) / 4 * 4);
  for (std::size_t i = 0; i < rays.size(); i += 4) {
    rays.origin.Set(i, p_world_.At(first + i) + Float4(kLift) * face_normal_.At(first + i));
  }
  const auto cast = [&](std::size_t channel) {
    casting.ray_scene.Visibility(rays, &visible);
    std::copy_n(visible.data(), rays.size(), sampled_[channel].data() + first);
  };
  for (FloatRow& channel : sampled_) std::fill_n(channel.data() + first, rays.size(), 1.0F);
  const std::vector<Light>& lights = casting.scene.lights();
  for (std::size_t k = 0; casting.options.shadows && k < lights.size(); ++k) {
    const Eigen::Vector3f& p_light = lights[k].p_world;
    const Float4 radius = lights[k].radius;
    const Vector4 p_world = {p_light.x() + radius * disc.x, p_light.y() + radius * disc.y,
                             p_light.z()};
    for (std::size_t i = 0; i < rays.size(); i += 4) {
      const Vector4 direction = p_world - rays.origin.At(i);
      const Float4 facing = Dot(face_normal_.At(first + i), direction);
      rays.direction.Set(i, direction);
      // A face that looks away has no light: -1, which is not cast.
      rays.length.Set(i, IfLess(0.0F, facing, 2.0F) - 1.0F);
    }
    cast(k);
  }
  if (casting.options.occlusion_reach <= 0) return;
  for (std::size_t i = 0; i < rays.size(); i += 4) {
    rays.direction.Set(i, AboveSurface(face_normal_.At(first + i), disc));
    rays.length.Set(i, casting.options.occlusion_reach);
  }
  rays.is_coherent = false;
  cast(kMaxLights);
}

void LightBuffer::FilterRow(int row) {
  const auto light_at = [this](std::size_t index) {
    Lighting result;
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = sampled_[i].At(index);
    return result;
  };
  for (int column = 0; column < num_columns_; column += 4) {
    const std::size_t index = IndexOf(column, row);
    const Place center = {p_world_.At(index), face_normal_.At(index), normal_.At(index),
                          footprint_.At(index)};
    Mean mean;
    mean.Add(kMinWeight, light_at(index));
    for (int y = std::max(0, row - 1); y < std::min(num_rows_, row + 3); ++y) {
      for (int x = column - 1; x < column + 3; ++x) {
        const std::size_t other = IndexOf(x, y);
        mean.Add(Affinity(center, p_world_.At(other), normal_.At(other)), light_at(other));
      }
    }
    const Lighting light = mean.Value();
    for (std::size_t i = 0; i < light.size(); ++i) filtered_[i].Set(index, light[i]);
  }
  for (FloatRow& channel : filtered_)  // For pixels right of the last sample.
    channel[IndexOf(num_columns_, row)] = channel[IndexOf(num_columns_ - 1, row)];
}

Lighting LightBuffer::AtPixels(const SurfacePoints& points,
                               std::size_t index,
                               int column,
                               int row) const {
  if (is_even_) return FullLight();
  const Place place = PlaceOf(points, index);
  Mean mean;
  const auto add = [&](std::size_t first, auto pick) {
    const auto pick_vectors = [&](const Vector4& value) -> Vector4 {
      return {pick(value.x), pick(value.y), pick(value.z)};
    };
    Lighting light;
    for (std::size_t i = 0; i < light.size(); ++i) light[i] = pick(filtered_[i].At(first));
    mean.Add(Affinity(place, pick_vectors(p_world_.At(first)), pick_vectors(normal_.At(first))) +
                 kMinWeight,
             light);
  };
  for (int dy = 0; dy <= (row & 1); ++dy) {
    const std::size_t first = IndexOf(column / 2, std::min(row / 2 + dy, num_rows_ - 1));
    add(first, LeftSamples);
    add(first, RightSamples);
  }
  return mean.Value();
}

Lighting LightBuffer::NearPixels(const SurfacePoints& points,
                                 std::size_t index,
                                 const std::array<int, 4>& columns,
                                 const std::array<int, 4>& rows) const {
  if (is_even_) return FullLight();
  const Place place = PlaceOf(points, index);
  Mean mean;
  for (int dy = 0; dy <= 1; ++dy) {  // The same sample more than once, if a pixel lies on it.
    for (int dx = 0; dx <= 1; ++dx) {
      std::array<std::size_t, 4> others;
      for (std::size_t lane = 0; lane < others.size(); ++lane) {
        const int column = (columns[lane] + dx) / 2;
        const int row = (rows[lane] + dy) / 2;
        others[lane] = IndexOf(std::min(column, num_columns_ - 1), std::min(row, num_rows_ - 1));
      }
      const auto gather = [&](const FloatRow& from) {
        return Float4(
            _mm_setr_ps(from[others[0]], from[others[1]], from[others[2]], from[others[3]]));
      };
      const auto gather_vectors = [&](const VectorRow& from) -> Vector4 {
        return {gather(from.x), gather(from.y), gather(from.z)};
      };
      Lighting light;
      for (std::size_t i = 0; i < light.size(); ++i) light[i] = gather(filtered_[i]);
      mean.Add(Affinity(place, gather_vectors(p_world_), gather_vectors(normal_)) + kMinWeight,
               light);
    }
  }
  return mean.Value();
}

}  // namespace semslam

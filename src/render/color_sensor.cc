// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "semslam/base/parallel.h"
#include "semslam/render/hash.h"
#include "semslam/render/sensor.h"

#include "render/lanes.h"

namespace semslam {
namespace {

constexpr std::size_t kRowsPerChunk = 8;
constexpr std::uint64_t kNoiseStream = 0xc0105;
constexpr std::uint64_t kDriftStream = 0xd21f7;

// Where surface points move in the picture during the exposure.
class Smear {
 public:
  Smear(const PinholeCamera& camera, const RayTable& rays, const FrameMotion& motion)
      : rays_(rays),
        fx_(static_cast<float>(camera.fx())),
        fy_(static_cast<float>(camera.fy())),
        open_(motion.T_world_camera_open.Inverse() * motion.T_world_camera),
        close_(motion.T_world_camera_close.Inverse() * motion.T_world_camera) {}

  // Displacements over the whole exposure for a row (pixels; distortion left aside: it changes
  // lengths by some percent only).
  void Fill(const cv::Mat& depth, int row, FloatRow* shift_x, FloatRow* shift_y) const {
    const int width = rays_.width();
    FloatRow x;
    FloatRow y;
    FloatRow z;
    for (FloatRow* list : {&x, &y, &z}) list->Resize(static_cast<std::size_t>(width));
    const auto* depths = depth.ptr<double>(row);
    for (int column = 0; column < width; ++column) {
      const Eigen::Vector2f& ray = rays_.At(column, row);
      x[column] = ray.x();
      y[column] = ray.y();
      z[column] = static_cast<float>(depths[column]);
    }
    for (int i = 0; i < width; i += 4) {
      const Float4 distance = z.At(i);
      const Vector4 p_camera = {x.At(i) * distance, y.At(i) * distance, distance};
      const Vector4 p_open = open_.Transform(p_camera);
      const Vector4 p_close = close_.Transform(p_camera);
      // 0 where there is no surface, or one that passes the camera.
      const Float4 nearest = Min(p_open.z, p_close.z);
      const Float4 over_open = Float4(1.0F) / Max(p_open.z, kNear);
      const Float4 over_close = Float4(1.0F) / Max(p_close.z, kNear);
      shift_x->Set(i,
                   IfLess(kNear, nearest, fx_ * (p_close.x * over_close - p_open.x * over_open)));
      shift_y->Set(i,
                   IfLess(kNear, nearest, fy_ * (p_close.y * over_close - p_open.y * over_open)));
    }
  }

 private:
  static constexpr float kNear = 0.01F;  // Metres.

  struct Motion {
    explicit Motion(const Rigid3& T_target_source)
        : R(T_target_source.rotation.toRotationMatrix().cast<float>()),
          t(T_target_source.translation.cast<float>()) {}
    Vector4 Transform(const Vector4& p) const {
      const auto component = [&](int k) -> Float4 {
        return R(k, 0) * p.x + R(k, 1) * p.y + R(k, 2) * p.z + t[k];
      };
      return {component(0), component(1), component(2)};
    }
    Eigen::Matrix3f R;
    Eigen::Vector3f t;
  };

  const RayTable& rays_;
  float fx_;
  float fy_;
  Motion open_;
  Motion close_;
};

// Two neighbours of a row: B, G, R, and a number that means nothing.
struct PixelPair {
  // Reads the pixels alone, as there may be nothing behind the last one.
  explicit PixelPair(const cv::Vec3f* pixels) : left(Float4::Load(pixels->val)) {
    const __m128 last_four = _mm_loadu_ps(pixels->val + 2);  // R, B, G, R
    right = Float4(_mm_shuffle_ps(last_four, last_four, _MM_SHUFFLE(0, 3, 2, 1)));
  }
  Float4 Between(Float4 weight) const { return left + weight * (right - left); }

  Float4 left;
  Float4 right;
};

// Bilinear, clamped at the borders.
Float4 RadianceAt(const cv::Mat& radiance, float x, float y) {
  x = std::clamp(x, 0.0F, static_cast<float>(radiance.cols - 1));
  y = std::clamp(y, 0.0F, static_cast<float>(radiance.rows - 1));
  const int x0 = std::min(static_cast<int>(x), radiance.cols - 2);
  const int y0 = std::min(static_cast<int>(y), radiance.rows - 2);
  const Float4 wx = x - static_cast<float>(x0);
  const Float4 wy = y - static_cast<float>(y0);
  const Float4 top = PixelPair(radiance.ptr<cv::Vec3f>(y0) + x0).Between(wx);
  const Float4 bottom = PixelPair(radiance.ptr<cv::Vec3f>(y0 + 1) + x0).Between(wx);
  return top + wy * (bottom - top);
}

// Mean along the line that the point draws during the exposure.
Float4 SmearedRadiance(const cv::Mat& radiance, int column, int row, float dx, float dy) {
  const float length = std::sqrt(dx * dx + dy * dy);
  if (length < 0.4F) {
    const int left = std::min(column, radiance.cols - 2);
    const PixelPair pair(radiance.ptr<cv::Vec3f>(row) + left);
    return left == column ? pair.left : pair.right;
  }
  const int num_taps = std::clamp(static_cast<int>(length + 0.9F), 2, 16);
  const float step = 1.0F / static_cast<float>(num_taps);
  Float4 sum;
  for (int i = 0; i < num_taps; ++i) {
    const float part = (static_cast<float>(i) + 0.5F) * step - 0.5F;
    sum += RadianceAt(radiance, static_cast<float>(column) + part * dx,
                      static_cast<float>(row) + part * dy);
  }
  return step * sum;
}

double GainAt(const FrameMotion& motion, const ColorSensorOptions& options) {
  const double phase = 2.0 * std::numbers::pi * UnitFloat(HashOf(motion.seed, kDriftStream));
  const double wave =
      0.6 * std::sin(0.7 * motion.time_s + phase) + 0.4 * std::sin(1.9 * motion.time_s + 2 * phase);
  return options.gain * (1.0 + options.gain_drift * wave);
}

// What a row needs on its way from light to levels. Colours are as in the picture: B, G, R, B, ...
struct RowBuffers {
  explicit RowBuffers(std::size_t width) : noise(3 * width + FloatRow::kRoom, kMeanNoise) {
    shift_x.Resize(width);
    shift_y.Resize(width);
    light.Resize(3 * width);
  }

  static constexpr std::uint8_t kMeanNoise = 62;

  FloatRow shift_x;
  FloatRow shift_y;
  FloatRow light;
  // Nearly normal: the sum of four whole numbers from 0 to 31. Never beyond 3.4 deviations.
  std::vector<std::uint8_t> noise;
};

void FillNoise(std::uint64_t frame_seed, int row, int width, std::uint8_t* noise) {
  // Three numbers for each of the three channels side by side; every second of the four numbers.
  constexpr std::uint64_t kTwo = 0x1fU | 0x1fU << 10;
  constexpr std::uint64_t kMask = kTwo | kTwo << 21 | kTwo << 42;
  const std::uint64_t first = static_cast<std::uint64_t>(row) * static_cast<std::uint64_t>(width);
  for (int x = 0; x < width; ++x) {
    const std::uint64_t bits = HashOf(frame_seed, first + static_cast<std::uint64_t>(x));
    const std::uint64_t pairs = (bits & kMask) + (bits >> 5 & kMask);
    const std::uint64_t sums = pairs + (pairs >> 10);
    for (int k = 0; k < 3; ++k)
      noise[3 * x + k] = static_cast<std::uint8_t>(sums >> (21 * k) & 0x7fU);
  }
}

// Light to grey level, with noise that grows with the level. `size`: colours of the row.
void DevelopRow(const RowBuffers& buffers,
                const ColorSensorOptions& options,
                int size,
                std::uint8_t* levels) {
  constexpr float kScale = 1.0F / 18.466185F;  // Variance 4 * (32^2 - 1) / 12.
  const auto read = static_cast<float>(options.read_noise);
  const auto shot = static_cast<float>(options.shot_noise);
  const __m128i zero = _mm_setzero_si128();
  const auto develop = [&](Float4 light, __m128i sums) {
    const Float4 noise =
        Float4(_mm_cvtepi32_ps(_mm_sub_epi32(sums, _mm_set1_epi32(RowBuffers::kMeanNoise)))) *
        kScale;
    const Float4 level = Min(Sqrt(Max(light, 0.0F)), 1.0F);
    const Float4 deviation = Sqrt(Float4(read * read) + Float4(shot * shot) * level);
    const Float4 value = Float4(255.0F) * level + deviation * noise + 0.5F;
    return _mm_cvttps_epi32(Min(Max(value, 0.0F), 255.0F).lanes);
  };
  for (int i = 0; i < size; i += 8) {
    const __m128i sums = _mm_unpacklo_epi8(
        _mm_loadl_epi64(reinterpret_cast<const __m128i*>(buffers.noise.data() + i)), zero);
    const __m128i words =
        _mm_packs_epi32(develop(buffers.light.At(i), _mm_unpacklo_epi16(sums, zero)),
                        develop(buffers.light.At(i + 4), _mm_unpackhi_epi16(sums, zero)));
    std::array<std::uint8_t, 8> bytes;
    _mm_storel_epi64(reinterpret_cast<__m128i*>(bytes.data()), _mm_packus_epi16(words, words));
    std::memcpy(levels + i, bytes.data(), std::min(8, size - i));
  }
}

}  // namespace

ColorSensorOptions ColorSensorOptions::Clean() {
  ColorSensorOptions options;
  options.exposure_s = 0;
  options.gain_drift = 0;
  options.vignetting = 0;
  options.read_noise = 0;
  options.shot_noise = 0;
  return options;
}

void ColorSensorOptions::Validate() const {
  const bool is_valid = exposure_s >= 0 && gain > 0 && gain_drift >= 0 && gain_drift < 1 &&
                        vignetting >= 0 && vignetting <= 1 && read_noise >= 0 && shot_noise >= 0;
  if (!is_valid) throw std::invalid_argument("colour sensor: an option is out of its range");
}

cv::Mat SenseColor(const IdealImage& ideal,
                   const PinholeCamera& camera,
                   const RayTable& rays,
                   const FrameMotion& motion,
                   const ColorSensorOptions& options,
                   int num_threads) {
  const Smear smear(camera, rays, motion);
  const auto gain = static_cast<float>(GainAt(motion, options));
  const auto vignetting = static_cast<float>(options.vignetting);
  const float center_x = 0.5F * static_cast<float>(camera.width());
  const float center_y = 0.5F * static_cast<float>(camera.height());
  const float corner = center_x * center_x + center_y * center_y;
  const std::uint64_t frame_seed = HashOf(motion.seed, kNoiseStream, motion.frame);
  const bool is_noisy = options.read_noise > 0 || options.shot_noise > 0;
  cv::Mat color(ideal.radiance.size(), CV_8UC3);
  const auto sense_row = [&](int row, RowBuffers& buffers) {
    if (options.exposure_s > 0) smear.Fill(ideal.depth, row, &buffers.shift_x, &buffers.shift_y);
    const float dy = static_cast<float>(row) - center_y;
    for (int x = 0; x < color.cols; ++x) {
      const float dx = static_cast<float>(x) - center_x;
      const float brightness = gain * (1.0F - vignetting * (dx * dx + dy * dy) / corner);
      const Float4 light = brightness * SmearedRadiance(ideal.radiance, x, row, buffers.shift_x[x],
                                                        buffers.shift_y[x]);
      buffers.light.Set(3 * static_cast<std::size_t>(x), light);  // One more: overwritten next.
    }
    if (is_noisy) FillNoise(frame_seed, row, color.cols, buffers.noise.data());
    DevelopRow(buffers, options, 3 * color.cols, color.ptr<std::uint8_t>(row));
  };
  ParallelFor(color.rows, kRowsPerChunk, num_threads, [&](std::size_t first, std::size_t last) {
    RowBuffers buffers(static_cast<std::size_t>(color.cols));
    for (std::size_t row = first; row < last; ++row) sense_row(static_cast<int>(row), buffers);
  });
  return color;
}

}  // namespace semslam

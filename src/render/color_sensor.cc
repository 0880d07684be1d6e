// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "semslam/base/parallel.h"
#include "semslam/render/hash.h"
#include "semslam/render/sensor.h"

namespace semslam {
namespace {

constexpr std::size_t kRowsPerChunk = 8;
constexpr std::uint64_t kNoiseStream = 0xc0105;
constexpr std::uint64_t kDriftStream = 0xd21f7;

// Where a surface point moves in the picture during the exposure.
class Smear {
 public:
  Smear(const PinholeCamera& camera, const RayTable& rays, const FrameMotion& motion)
      : camera_(camera),
        rays_(rays),
        T_open_camera_(motion.T_world_camera_open.Inverse() * motion.T_world_camera),
        T_close_camera_(motion.T_world_camera_close.Inverse() * motion.T_world_camera),
        R_open_(T_open_camera_.rotation.toRotationMatrix().cast<float>()),
        R_close_(T_close_camera_.rotation.toRotationMatrix().cast<float>()) {}

  // Displacement over the whole exposure, pixels (distortion left aside: it changes lengths by
  // some percent only).
  Eigen::Vector2f At(int column, int row, float depth) const {
    const Eigen::Vector3f p_camera = rays_.Unproject(column, row, depth);
    const Eigen::Vector3f p_open = R_open_ * p_camera + T_open_camera_.translation.cast<float>();
    const Eigen::Vector3f p_close = R_close_ * p_camera + T_close_camera_.translation.cast<float>();
    if (p_open.z() <= 0.01F || p_close.z() <= 0.01F) return Eigen::Vector2f::Zero();
    const Eigen::Vector2f shift = p_close.head<2>() / p_close.z() - p_open.head<2>() / p_open.z();
    return {shift.x() * static_cast<float>(camera_.fx()),
            shift.y() * static_cast<float>(camera_.fy())};
  }

 private:
  const PinholeCamera& camera_;
  const RayTable& rays_;
  Rigid3 T_open_camera_;
  Rigid3 T_close_camera_;
  Eigen::Matrix3f R_open_;
  Eigen::Matrix3f R_close_;
};

Eigen::Vector3f PixelAt(const cv::Mat& radiance, int column, int row) {
  const auto& pixel = radiance.ptr<cv::Vec3f>(row)[column];
  return {pixel[0], pixel[1], pixel[2]};
}

// Bilinear, clamped at the borders.
Eigen::Vector3f RadianceAt(const cv::Mat& radiance, float x, float y) {
  x = std::clamp(x, 0.0F, static_cast<float>(radiance.cols - 1));
  y = std::clamp(y, 0.0F, static_cast<float>(radiance.rows - 1));
  const int x0 = std::min(static_cast<int>(x), radiance.cols - 2);
  const int y0 = std::min(static_cast<int>(y), radiance.rows - 2);
  const float wx = x - static_cast<float>(x0);
  const float wy = y - static_cast<float>(y0);
  return (PixelAt(radiance, x0, y0) * (1 - wx) + PixelAt(radiance, x0 + 1, y0) * wx) * (1 - wy) +
         (PixelAt(radiance, x0, y0 + 1) * (1 - wx) + PixelAt(radiance, x0 + 1, y0 + 1) * wx) * wy;
}

// Mean along the line that the point draws during the exposure.
Eigen::Vector3f SmearedRadiance(const cv::Mat& radiance,
                                int column,
                                int row,
                                const Eigen::Vector2f& smear) {
  const float length = smear.norm();
  if (length < 0.4F) return PixelAt(radiance, column, row);
  const int num_taps = std::clamp(static_cast<int>(length + 0.9F), 2, 16);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (int i = 0; i < num_taps; ++i) {
    const float part = (static_cast<float>(i) + 0.5F) / static_cast<float>(num_taps) - 0.5F;
    sum += RadianceAt(radiance, static_cast<float>(column) + part * smear.x(),
                      static_cast<float>(row) + part * smear.y());
  }
  return sum / static_cast<float>(num_taps);
}

double GainAt(const FrameMotion& motion, const ColorSensorOptions& options) {
  const double phase = 2.0 * std::numbers::pi * UnitFloat(HashOf(motion.seed, kDriftStream));
  const double wave =
      0.6 * std::sin(0.7 * motion.time_s + phase) + 0.4 * std::sin(1.9 * motion.time_s + 2 * phase);
  return options.gain * (1.0 + options.gain_drift * wave);
}

// Light to grey level, with noise that grows with the level.
std::uint8_t Develop(float radiance, std::uint64_t hash, const ColorSensorOptions& options) {
  const float level = std::min(1.0F, std::sqrt(std::max(0.0F, radiance)));
  const auto read = static_cast<float>(options.read_noise);
  const auto shot = static_cast<float>(options.shot_noise);
  const float deviation = std::sqrt(read * read + shot * shot * level);
  return static_cast<std::uint8_t>(
      std::clamp(255.0F * level + deviation * NormalFloat(hash) + 0.5F, 0.0F, 255.0F));
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
  cv::Mat color(ideal.radiance.size(), CV_8UC3);
  const auto sense_row = [&](int row) {
    const float dy = static_cast<float>(row) - center_y;
    for (int x = 0; x < color.cols; ++x) {
      const auto depth = static_cast<float>(ideal.depth.at<double>(row, x));
      const Eigen::Vector2f shift =
          options.exposure_s > 0 ? smear.At(x, row, depth) : Eigen::Vector2f(0, 0);
      const float dx = static_cast<float>(x) - center_x;
      const float brightness = gain * (1.0F - vignetting * (dx * dx + dy * dy) / corner);
      const Eigen::Vector3f light = brightness * SmearedRadiance(ideal.radiance, x, row, shift);
      auto& pixel = color.at<cv::Vec3b>(row, x);
      std::uint64_t hash = HashOf(frame_seed, static_cast<std::uint64_t>(row) * color.cols + x);
      for (int k = 0; k < 3; ++k) {
        pixel[k] = Develop(light[k], hash, options);
        hash = MixBits(hash);
      }
    }
  };
  ParallelFor(color.rows, kRowsPerChunk, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t row = first; row < last; ++row) sense_row(static_cast<int>(row));
  });
  return color;
}

}  // namespace semslam

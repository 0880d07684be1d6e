// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "semslam/base/parallel.h"
#include "semslam/render/hash.h"
#include "semslam/render/sensor.h"

namespace semslam {
namespace {

constexpr std::size_t kRowsPerChunk = 8;
constexpr std::uint64_t kDepthStream = 0xde9;
constexpr double kJump = 0.03;  // Depths that differ by more than this part belong to two surfaces.

double Disparity(const DepthSensorOptions& options, double depth) {
  return options.focal_px * options.baseline_m / depth;
}

// Marks the pixels of a row whose point the projector does not reach: another point of the row, as
// seen from the projector, lies in the same direction and nearer. The projector is to the camera's
// right, so its view of a pixel is shifted left by the disparity, and shadows lie to the left of
// what casts them.
std::vector<std::uint8_t> ShadowedPixels(const double* depth,
                                         int width,
                                         const DepthSensorOptions& options) {
  std::vector<std::uint8_t> shadowed(static_cast<std::size_t>(width), 0);
  // From the right to the left, a lit surface's directions go left as well. What falls back behind
  // the leftmost direction so far is hidden by the nearer point that was there.
  double leftmost = std::numeric_limits<double>::infinity();
  for (int x = width - 1; x >= 0; --x) {
    if (depth[x] <= 0) continue;
    const double direction = x - Disparity(options, depth[x]);
    if (direction > leftmost + 0.5) {
      shadowed[x] = 1;
    } else {
      leftmost = std::min(leftmost, direction);
    }
  }
  return shadowed;
}

// 1 for each pixel of a row from which one of the four neighbours differs by a jump.
void FindJumps(const cv::Mat& depth, int row, std::vector<std::uint8_t>* beside_jump) {
  const auto* center = depth.ptr<double>(row);
  const auto* above = depth.ptr<double>(std::max(row - 1, 0));
  const auto* below = depth.ptr<double>(std::min(row + 1, depth.rows - 1));
  const int last = depth.cols - 1;
  beside_jump->resize(static_cast<std::size_t>(depth.cols));
  for (int x = 0; x <= last; ++x) {
    const double z = center[x];
    const double left = center[x > 0 ? x - 1 : 0];
    const double right = center[x < last ? x + 1 : last];
    const double largest = std::max(std::max(left, right), std::max(above[x], below[x]));
    const double smallest = std::min(std::min(left, right), std::min(above[x], below[x]));
    (*beside_jump)[x] = std::max(largest - z, z - smallest) > kJump * z ? 1 : 0;
  }
}

// The whole number nearest to a number of at most a million.
int NearestInt(double value) {
  constexpr double kShift = 1048576.0;  // So that cutting the fraction off rounds down.
  return static_cast<int>(value + (kShift + 0.5)) - static_cast<int>(kShift);
}

// The depth where a pixel really looks.
double FrayedDepth(const cv::Mat& depth, int x, int y, double fray, std::uint64_t hash) {
  const double center = depth.at<double>(y, x);
  if (fray <= 0) return center;
  const int shift_x = NearestInt(fray * NormalFloat(hash));
  const int shift_y = NearestInt(fray * NormalFloat(MixBits(hash)));
  if (shift_x == 0 && shift_y == 0) return center;
  const double frayed = depth.at<double>(std::clamp(y + shift_y, 0, depth.rows - 1),
                                         std::clamp(x + shift_x, 0, depth.cols - 1));
  // Only over a jump: on one surface the sensor's window averages such shifts away.
  return std::abs(frayed - center) > kJump * center ? frayed : center;
}

// Noise and steps of the disparity.
double MeasuredDepth(double depth, const DepthSensorOptions& options, std::uint64_t hash) {
  double disparity = Disparity(options, depth) + options.disparity_noise_px * NormalFloat(hash);
  if (options.disparity_step_px > 0) {
    disparity = std::floor(disparity / options.disparity_step_px + 0.5) * options.disparity_step_px;
  }
  if (disparity <= 0) return 0;
  return options.focal_px * options.baseline_m / disparity;
}

}  // namespace

DepthSensorOptions DepthSensorOptions::Clean() {
  DepthSensorOptions options;
  options.disparity_step_px = 0;
  options.disparity_noise_px = 0;
  options.fray_px = 0;
  options.min_depth_m = 0;
  options.max_depth_m = std::numeric_limits<double>::infinity();
  options.min_incidence = 0;
  options.projector_shadow = false;
  options.hole_rate = 0;
  return options;
}

void DepthSensorOptions::Validate() const {
  const bool is_valid = focal_px > 0 && baseline_m > 0 && disparity_step_px >= 0 &&
                        disparity_noise_px >= 0 && fray_px >= 0 && min_depth_m >= 0 &&
                        max_depth_m > min_depth_m && min_incidence >= 0 && min_incidence <= 1 &&
                        hole_rate >= 0 && hole_rate <= 1;
  if (!is_valid) throw std::invalid_argument("depth sensor: an option is out of its range");
}

cv::Mat SenseDepth(const IdealImage& ideal,
                   const FrameMotion& motion,
                   const DepthSensorOptions& options,
                   double depth_factor,
                   int num_threads) {
  const std::uint64_t frame_seed = HashOf(motion.seed, kDepthStream, motion.frame);
  const cv::Mat& truth = ideal.depth;
  cv::Mat depth(truth.size(), CV_16UC1, cv::Scalar(0));
  const auto sense_row = [&](int row) {
    const auto* depths = truth.ptr<double>(row);
    const auto* incidence = ideal.incidence.ptr<float>(row);
    auto* sensed = depth.ptr<std::uint16_t>(row);
    std::vector<std::uint8_t> shadowed(static_cast<std::size_t>(truth.cols), 0);
    std::vector<std::uint8_t> beside_jump;
    if (options.projector_shadow) shadowed = ShadowedPixels(depths, truth.cols, options);
    FindJumps(truth, row, &beside_jump);
    for (int x = 0; x < truth.cols; ++x) {
      if (depths[x] <= 0 || shadowed[x] != 0 || incidence[x] < options.min_incidence) continue;
      const std::uint64_t hash =
          HashOf(frame_seed, static_cast<std::uint64_t>(row) * truth.cols + x);
      if (beside_jump[x] != 0 && UnitFloat(hash) < options.hole_rate) continue;
      const double frayed = FrayedDepth(truth, x, row, options.fray_px, MixBits(hash + 1));
      if (frayed <= 0) continue;
      const double measured = MeasuredDepth(frayed, options, MixBits(hash + 2));
      if (measured < options.min_depth_m || measured > options.max_depth_m) continue;
      const double units = measured * depth_factor + 0.5;
      if (units < std::numeric_limits<std::uint16_t>::max() + 1.0)
        sensed[x] = static_cast<std::uint16_t>(units);
    }
  };
  ParallelFor(depth.rows, kRowsPerChunk, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t row = first; row < last; ++row) sense_row(static_cast<int>(row));
  });
  return depth;
}

}  // namespace semslam

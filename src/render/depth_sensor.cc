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

// Infinite where there is no surface.
void FillDisparities(const double* depths,
                     const DepthSensorOptions& options,
                     std::vector<double>* disparities) {
  const double product = options.focal_px * options.baseline_m;
  for (std::size_t x = 0; x < disparities->size(); ++x) (*disparities)[x] = product / depths[x];
}

// Marks the pixels of a row whose point the projector does not reach: another point of the row, as
// seen from the projector, lies in the same direction and nearer. The projector is to the camera's
// right, so its view of a pixel is shifted left by the disparity, and shadows lie to the left of
// what casts them.
void FindShadows(const double* depth,
                 const std::vector<double>& disparities,
                 std::vector<std::uint8_t>* shadowed) {
  // From the right to the left, a lit surface's directions go left as well. What falls back behind
  // the leftmost direction so far is hidden by the nearer point that was there.
  double leftmost = std::numeric_limits<double>::infinity();
  for (int x = static_cast<int>(disparities.size()) - 1; x >= 0; --x) {
    (*shadowed)[x] = 0;
    if (depth[x] <= 0) continue;
    const double direction = x - disparities[x];
    (*shadowed)[x] = direction > leftmost + 0.5 ? 1 : 0;
    leftmost = std::min(leftmost, direction);
  }
}

// 1 for each pixel of a row from which another one, at most `reach` rows and columns away, differs
// by a jump.
class JumpFinder {
 public:
  JumpFinder(const cv::Mat& depth, int reach)
      : depth_(depth),
        reach_(reach),
        lowest_(static_cast<std::size_t>(depth.cols) + 2 * reach),
        highest_(lowest_.size()),
        low_(static_cast<std::size_t>(depth.cols)),
        high_(low_.size()) {}

  void Find(int row, std::vector<std::uint8_t>* near_jump) {
    FindColumnLimits(row);
    const std::size_t width = low_.size();
    std::copy_n(lowest_.begin(), width, low_.begin());
    std::copy_n(highest_.begin(), width, high_.begin());
    for (int shift = 1; shift <= 2 * reach_; ++shift) {
      for (std::size_t x = 0; x < width; ++x) {
        low_[x] = std::min(low_[x], lowest_[x + shift]);
        high_[x] = std::max(high_[x], highest_[x + shift]);
      }
    }
    const auto* center = depth_.ptr<double>(row);
    for (std::size_t x = 0; x < width; ++x) {
      const double z = center[x];
      (*near_jump)[x] = std::max(high_[x] - z, z - low_[x]) > kJump * z ? 1 : 0;
    }
  }

 private:
  // Of each column, within reach of the row. Before the first and behind the last column they
  // are repeated.
  void FindColumnLimits(int row) {
    const std::size_t width = low_.size();
    double* lowest = lowest_.data() + reach_;
    double* highest = highest_.data() + reach_;
    std::copy_n(depth_.ptr<double>(row), width, lowest);
    std::copy_n(depth_.ptr<double>(row), width, highest);
    const int last = std::min(row + reach_, depth_.rows - 1);
    for (int y = std::max(row - reach_, 0); y <= last; ++y) {
      const auto* depths = depth_.ptr<double>(y);
      for (std::size_t x = 0; x < width; ++x) {
        lowest[x] = std::min(lowest[x], depths[x]);
        highest[x] = std::max(highest[x], depths[x]);
      }
    }
    for (std::vector<double>* limits : {&lowest_, &highest_}) {
      std::fill_n(limits->begin(), reach_, (*limits)[reach_]);
      std::fill_n(limits->rbegin(), reach_, (*limits)[width + reach_ - 1]);
    }
  }

  const cv::Mat& depth_;
  int reach_;
  std::vector<double> lowest_;
  std::vector<double> highest_;
  std::vector<double> low_;
  std::vector<double> high_;
};

// 1 for each pixel of a row from which one of the four neighbours differs by a jump.
void FindJumps(const cv::Mat& depth, int row, std::vector<std::uint8_t>* beside_jump) {
  const auto* center = depth.ptr<double>(row);
  const auto* above = depth.ptr<double>(std::max(row - 1, 0));
  const auto* below = depth.ptr<double>(std::min(row + 1, depth.rows - 1));
  const int last = depth.cols - 1;
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

// Nearly normal as NormalFloat, from 32 bits: the sum of four numbers of eight.
float NormalFromHalf(std::uint32_t bits) {
  const std::uint32_t pairs = (bits & 0xff00ffU) + (bits >> 8 & 0xff00ffU);
  const auto sum = static_cast<int>((pairs & 0xffffU) + (pairs >> 16));
  // Mean 2 * 255, variance 4 * (256^2 - 1) / 12.
  return static_cast<float>(sum - 510) * (1.0F / 147.80053F);
}

// The farthest that FrayedDepth looks, in rows and columns.
int FrayReach(float fray) { return NearestInt(fray * NormalFromHalf(0xffffffffU)); }

// The depth where a pixel really looks.
double FrayedDepth(const cv::Mat& depth, int x, int y, float fray, std::uint64_t hash) {
  const double center = depth.at<double>(y, x);
  const int shift_x = NearestInt(fray * NormalFromHalf(static_cast<std::uint32_t>(hash)));
  const int shift_y = NearestInt(fray * NormalFromHalf(static_cast<std::uint32_t>(hash >> 32)));
  if (shift_x == 0 && shift_y == 0) return center;
  const double frayed = depth.at<double>(std::clamp(y + shift_y, 0, depth.rows - 1),
                                         std::clamp(x + shift_x, 0, depth.cols - 1));
  // Only over a jump: on one surface the sensor's window averages such shifts away.
  return std::abs(frayed - center) > kJump * center ? frayed : center;
}

// What a row needs. What an option turns off stays 0.
struct RowBuffers {
  RowBuffers(const cv::Mat& depth, int fray_reach)
      : disparities(static_cast<std::size_t>(depth.cols)),
        shadowed(disparities.size(), 0),
        beside_jump(disparities.size(), 0),
        near_jump(disparities.size(), 0),
        jumps(depth, fray_reach) {}

  std::vector<double> disparities;
  std::vector<std::uint8_t> shadowed;
  std::vector<std::uint8_t> beside_jump;  // Of one of the four neighbours.
  std::vector<std::uint8_t> near_jump;    // Within reach of fraying.
  JumpFinder jumps;
};

// Noise and steps of the disparity.
class DisparityMeter {
 public:
  explicit DisparityMeter(const DepthSensorOptions& options)
      : product_(options.focal_px * options.baseline_m),
        noise_(options.disparity_noise_px),
        step_(options.disparity_step_px),
        per_step_(step_ > 0 ? 1.0 / step_ : 0.0) {}

  double DepthOf(double disparity, std::uint64_t hash) const {
    disparity += noise_ * NormalFloat(hash);
    if (step_ > 0) disparity = NearestInt(std::min(disparity * per_step_, kMaxSteps)) * step_;
    return disparity > 0 ? product_ / disparity : 0.0;
  }

 private:
  static constexpr double kMaxSteps = 1e6;  // Far beyond any range.

  double product_;
  double noise_;
  double step_;
  double per_step_;
};

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
  const DisparityMeter meter(options);
  const auto fray = static_cast<float>(options.fray_px);
  cv::Mat depth(truth.size(), CV_16UC1, cv::Scalar(0));
  const auto sense_row = [&](int row, RowBuffers& buffers) {
    const auto* depths = truth.ptr<double>(row);
    const auto* incidence = ideal.incidence.ptr<float>(row);
    auto* sensed = depth.ptr<std::uint16_t>(row);
    FillDisparities(depths, options, &buffers.disparities);
    if (options.projector_shadow) FindShadows(depths, buffers.disparities, &buffers.shadowed);
    if (options.hole_rate > 0) FindJumps(truth, row, &buffers.beside_jump);
    if (fray > 0) buffers.jumps.Find(row, &buffers.near_jump);
    for (int x = 0; x < truth.cols; ++x) {
      if (depths[x] <= 0 || buffers.shadowed[x] != 0 || incidence[x] < options.min_incidence)
        continue;
      const std::uint64_t hash =
          HashOf(frame_seed, static_cast<std::uint64_t>(row) * truth.cols + x);
      if (buffers.beside_jump[x] != 0 && UnitFloat(hash) < options.hole_rate) continue;
      double disparity = buffers.disparities[x];
      if (buffers.near_jump[x] != 0) {
        const double frayed = FrayedDepth(truth, x, row, fray, MixBits(hash + 1));
        if (frayed <= 0) continue;
        if (frayed != depths[x]) disparity = Disparity(options, frayed);
      }
      const double measured = meter.DepthOf(disparity, MixBits(hash + 2));
      if (measured < options.min_depth_m || measured > options.max_depth_m) continue;
      const double units = measured * depth_factor + 0.5;
      if (units < std::numeric_limits<std::uint16_t>::max() + 1.0)
        sensed[x] = static_cast<std::uint16_t>(units);
    }
  };
  ParallelFor(depth.rows, kRowsPerChunk, num_threads, [&](std::size_t first, std::size_t last) {
    RowBuffers buffers(truth, FrayReach(fray));
    for (std::size_t row = first; row < last; ++row) sense_row(static_cast<int>(row), buffers);
  });
  return depth;
}

}  // namespace semslam

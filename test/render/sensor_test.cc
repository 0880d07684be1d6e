// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/sensor.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "semslam/render/scenes.h"

namespace semslam {
namespace {

constexpr double kDepthFactor = 5000;
const cv::Size kSize(640, 480);

// A grey wall that fills the picture.
IdealImage Wall(double depth, float radiance = 0.25F) {
  return {cv::Mat(kSize, CV_32FC3, cv::Scalar::all(radiance)),
          cv::Mat(kSize, CV_64FC1, cv::Scalar(depth)), cv::Mat(kSize, CV_16UC1, cv::Scalar(1)),
          cv::Mat(kSize, CV_32FC1, cv::Scalar(1))};
}

// Left of column 320 the wall is at `left`, else at `right`.
IdealImage Step(double left, double right) {
  IdealImage image = Wall(right);
  image.depth.colRange(0, 320).setTo(left);
  return image;
}

cv::Mat DepthOf(const IdealImage& ideal,
                const DepthSensorOptions& options,
                std::uint64_t frame = 0) {
  return SenseDepth(ideal, {.seed = 1, .frame = frame}, options, kDepthFactor, 1);
}

struct Statistics {
  double mean;
  double deviation;
};

Statistics DepthError(const cv::Mat& depth_16u, double truth) {
  cv::Mat depth;
  depth_16u.convertTo(depth, CV_64F, 1 / kDepthFactor, -truth);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(depth, mean, deviation);
  return {mean[0], deviation[0]};
}

TEST(DepthSensor, CleanDepthIsRoundedAndNothingElse) {
  const IdealImage ideal = Wall(7.12345);
  const cv::Mat depth = DepthOf(ideal, DepthSensorOptions::Clean());
  EXPECT_EQ(cv::countNonZero(depth != 35617), 0);  // 7.12345 * 5000 = 35617.25
}

class DepthNoiseTest : public ::testing::TestWithParam<double> {};

TEST_P(DepthNoiseTest, GrowsWithTheSquareOfDepthAsModelled) {
  const double z = GetParam();
  const DepthSensorOptions options;
  const Statistics error = DepthError(DepthOf(Wall(z), options), z);
  // Independent: noise and the uniform error of rounding to steps. Where a step is wider than the
  // noise, rounding is not quite uniform.
  const double disparity_deviation =
      std::hypot(options.disparity_noise_px, options.disparity_step_px / std::sqrt(12.0));
  const double expected = z * z / (options.focal_px * options.baseline_m) * disparity_deviation;
  EXPECT_NEAR(error.deviation, expected, 0.25 * expected);
  EXPECT_LT(std::abs(error.mean), 0.6 * expected);
}

INSTANTIATE_TEST_SUITE_P(Depths, DepthNoiseTest, ::testing::Values(0.7, 1.0, 1.7, 2.5, 3.6));

TEST(DepthSensor, NoiseAloneHasTheModelledDeviation) {
  DepthSensorOptions options;
  options.disparity_step_px = 0;
  const Statistics error = DepthError(DepthOf(Wall(2.0), options), 2.0);
  const double expected =
      4.0 / (options.focal_px * options.baseline_m) * options.disparity_noise_px;
  EXPECT_NEAR(error.deviation, expected, 0.02 * expected);
  EXPECT_LT(std::abs(error.mean), 0.02 * expected);
}

TEST(DepthSensor, NoiseOfTwoFramesIsIndependent) {
  DepthSensorOptions options;
  options.disparity_step_px = 0;
  cv::Mat difference;
  cv::subtract(DepthOf(Wall(2.0), options, 1), DepthOf(Wall(2.0), options, 2), difference, {},
               CV_64F);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(difference / kDepthFactor, mean, deviation);
  const double single = 4.0 / (options.focal_px * options.baseline_m) * options.disparity_noise_px;
  EXPECT_NEAR(deviation[0], std::sqrt(2.0) * single, 0.02 * single);
}

TEST(DepthSensor, DepthComesInStepsOfDisparity) {
  DepthSensorOptions options = DepthSensorOptions::Clean();
  options.disparity_step_px = 0.125;
  IdealImage ideal = Wall(1.0);
  for (int x = 0; x < kSize.width; ++x) ideal.depth.col(x).setTo(0.95 + 0.1 * x / kSize.width);
  const cv::Mat depth = DepthOf(ideal, options);
  std::set<int> values;
  for (int x = 0; x < kSize.width; ++x) values.insert(depth.at<std::uint16_t>(0, x));
  // Disparity runs from 43.5 / 0.95 to 43.5 / 1.05 px: 34.9 steps.
  EXPECT_NEAR(static_cast<double>(values.size()), 35.5, 1.0);
  for (const int value : values) {
    const double steps = options.focal_px * options.baseline_m / (value / kDepthFactor) / 0.125;
    EXPECT_NEAR(steps, std::round(steps), 0.04);  // Rounding to 0.2 mm is 0.035 of a step.
  }
}

TEST(DepthSensor, HolesBesideAJumpAreAsFrequentAsSaid) {
  DepthSensorOptions options = DepthSensorOptions::Clean();
  options.hole_rate = 0.3;
  const cv::Mat depth = DepthOf(Step(1.0, 2.0), options);
  const double num_missing = kSize.height * 2 - cv::countNonZero(depth.colRange(319, 321));
  EXPECT_NEAR(num_missing / (kSize.height * 2), 0.3, 0.06);  // Four standard deviations.
  EXPECT_EQ(cv::countNonZero(depth), kSize.area() - static_cast<int>(num_missing));
}

TEST(DepthSensor, OutOfRangeIsMissing) {
  EXPECT_EQ(cv::countNonZero(DepthOf(Wall(0.4), {})), 0);
  EXPECT_EQ(cv::countNonZero(DepthOf(Wall(4.8), {})), 0);
  EXPECT_EQ(cv::countNonZero(DepthOf(Wall(2.0), {})), kSize.area());
}

TEST(DepthSensor, GrazingSurfacesAreMissing) {
  IdealImage ideal = Wall(2.0);
  ideal.incidence.colRange(0, 100).setTo(0.1);
  const cv::Mat depth = DepthOf(ideal, {});
  EXPECT_EQ(cv::countNonZero(depth.colRange(0, 100)), 0);
  EXPECT_EQ(cv::countNonZero(depth.colRange(100, 640)), 540 * 480);
}

TEST(DepthSensor, ANearSurfaceShadowsTheWallToItsLeft) {
  DepthSensorOptions options = DepthSensorOptions::Clean();
  options.projector_shadow = true;
  const cv::Mat depth = DepthOf(Step(2.0, 1.0), options);  // The near one is on the right.
  const double expected = options.focal_px * options.baseline_m * (1 / 1.0 - 1 / 2.0);
  const int num_missing = kSize.width - cv::countNonZero(depth.row(100));
  EXPECT_NEAR(num_missing, expected, 1.5);
  EXPECT_EQ(cv::countNonZero(depth.row(100).colRange(320 - num_missing, 320)), 0);
}

TEST(DepthSensor, NoShadowWhereTheNearSurfaceIsOnTheLeft) {
  DepthSensorOptions options = DepthSensorOptions::Clean();
  options.projector_shadow = true;
  EXPECT_EQ(cv::countNonZero(DepthOf(Step(1.0, 2.0), options)), kSize.area());
}

TEST(DepthSensor, OnlyPixelsBesideAJumpAreFrayedOrMissing) {
  DepthSensorOptions options;
  options.disparity_noise_px = 0;
  options.disparity_step_px = 0;
  options.projector_shadow = false;
  const IdealImage ideal = Step(2.0, 1.0);
  cv::Mat wrong = DepthOf(ideal, options) != DepthOf(ideal, DepthSensorOptions::Clean());
  EXPECT_GT(cv::countNonZero(wrong.colRange(318, 322)), 100);
  wrong.colRange(318, 322).setTo(0);
  EXPECT_EQ(cv::countNonZero(wrong), 0);
}

cv::Mat ColorOf(const IdealImage& ideal,
                const ColorSensorOptions& options,
                const FrameMotion& motion = {}) {
  const PinholeCamera camera(CameraByName("TUM3"));
  return SenseColor(ideal, camera, RayTable(camera), motion, options, 1);
}

TEST(ColorSensor, CleanColourIsTheRootOfRadiance) {
  const cv::Mat color = ColorOf(Wall(2.0, 0.25F), ColorSensorOptions::Clean());
  EXPECT_EQ(cv::countNonZero(color.reshape(1) != 128), 0);  // 255 * 0.5 = 127.5, rounded up.
}

TEST(ColorSensor, NoiseHasTheModelledDeviation) {
  ColorSensorOptions options = ColorSensorOptions::Clean();
  options.read_noise = 2.0;
  options.shot_noise = 3.0;
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(ColorOf(Wall(2.0, 0.25F), options), mean, deviation);
  const double expected = std::sqrt(4.0 + 9.0 * 0.5 + 1.0 / 12.0);  // And rounding to whole levels.
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(deviation[k], expected, 0.02 * expected);
    EXPECT_NEAR(mean[k], 127.5, 0.05);
  }
}

TEST(ColorSensor, TurningSmearsAnEdgeOverTheExposure) {
  IdealImage ideal = Wall(2.0, 0.0F);
  ideal.radiance.colRange(320, 640).setTo(cv::Scalar::all(1.0));
  ColorSensorOptions options = ColorSensorOptions::Clean();
  options.exposure_s = 0.02;
  FrameMotion motion;
  constexpr double kHalfAngle = 0.005;  // About 2.7 px to either side.
  motion.T_world_camera_open.rotation = ExpSO3({0, -kHalfAngle, 0});
  motion.T_world_camera_close.rotation = ExpSO3({0, kHalfAngle, 0});
  const cv::Mat color = ColorOf(ideal, options, motion);
  int num_between = 0;
  for (int x = 0; x < 640; ++x) {
    const int level = color.at<cv::Vec3b>(240, x)[0];
    num_between += level > 0 && level < 255 ? 1 : 0;
  }
  EXPECT_NEAR(num_between, 2 * kHalfAngle * CameraByName("TUM3").fx, 1.5);
}

// Width of the ramp that an edge becomes, from its steepness.
double RampWidth(const cv::Mat& color) {
  double light_sum = 0;
  for (int x = 280; x < 360; ++x) {
    const double level = color.at<cv::Vec3b>(240, x)[0] / 255.0;
    light_sum += level * level * (1 - level * level);  // Light is the square of the level.
  }
  return 6 * light_sum;  // The integral of t (1 - t) over a ramp is a sixth of its width.
}

TEST(ColorSensor, MovingSidewaysSmearsByVelocityTimesExposureOverDepth) {
  constexpr double kDepth = 1.5;
  constexpr double kVelocity = 1.2;  // m/s, to the right.
  constexpr double kExposure = 0.02;
  IdealImage ideal = Wall(kDepth, 0.0F);
  ideal.radiance.colRange(320, 640).setTo(cv::Scalar::all(1.0));
  ColorSensorOptions options = ColorSensorOptions::Clean();
  options.exposure_s = kExposure;
  FrameMotion motion;
  motion.T_world_camera_open.translation.x() = -0.5 * kVelocity * kExposure;
  motion.T_world_camera_close.translation.x() = 0.5 * kVelocity * kExposure;
  const double expected = CameraByName("TUM3").fx * kVelocity * kExposure / kDepth;  // 8.6 px
  EXPECT_NEAR(RampWidth(ColorOf(ideal, options, motion)), expected, 0.4);
}

TEST(ColorSensor, ExposureChangesSlowlyAndWithinItsLimit) {
  ColorSensorOptions options = ColorSensorOptions::Clean();
  options.gain_drift = 0.06;
  double smallest = 10;
  double largest = 0;
  double before = 0;
  for (int frame = 0; frame < 300; frame += 10) {
    const FrameMotion motion = {.seed = 5, .time_s = frame / 30.0};
    const double level = ColorOf(Wall(2.0, 0.25F), options, motion).at<cv::Vec3b>(0, 0)[0];
    const double gain = level * level / (255.0 * 255.0) / 0.25;
    smallest = std::min(smallest, gain);
    largest = std::max(largest, gain);
    if (frame > 0) {
      EXPECT_LT(std::abs(gain - before), 0.04) << frame;
    }
    before = gain;
  }
  EXPECT_LT(largest - smallest, 0.13);  // 2 * 0.06 and rounding to whole levels.
  EXPECT_GT(largest - smallest, 0.06);
}

TEST(SensorOptions, ImpossibleOnesAreRefused) {
  DepthSensorOptions depth;
  depth.hole_rate = 1.5;
  EXPECT_THROW(depth.Validate(), std::invalid_argument);
  ColorSensorOptions color;
  color.gain = 0;
  EXPECT_THROW(color.Validate(), std::invalid_argument);
  EXPECT_NO_THROW(DepthSensorOptions::Clean().Validate());
  EXPECT_NO_THROW(ColorSensorOptions::Clean().Validate());
}

}  // namespace
}  // namespace semslam

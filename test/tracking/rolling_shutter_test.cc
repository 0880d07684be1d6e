// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/tracking/rolling_shutter.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>

#include <gtest/gtest.h>

#include "semslam/mapping/local_mapping.h"
#include "semslam/tracking/tracking.h"

#include "support/synthetic_frames.h"
#include "tracking/noisy_world.h"

namespace semslam {
namespace {

using testing::SyntheticView;
using testing::SyntheticWorld;

constexpr double kReadout = 0.02;

// As a hand shakes, from rest: up to 0.9 rad/s and 0.5 m/s.
Rigid3 Shaking(double t) {
  const auto swing = [t](double amplitude, double frequency) {
    return amplitude * (1 - std::cos(frequency * t));
  };
  return {ExpSO3({swing(0.10, 5.0), swing(-0.12, 3.7), swing(0.06, 6.1)}),
          {swing(0.08, 4.3), swing(-0.06, 5.3), swing(0.05, 3.1)}};
}

class RollingShutterTest : public testing::NoisyWorldTest {
 protected:
  struct Outcome {
    double rms_error = 0;  // Metres, over the last second.
    double readout = 0;    // As it was corrected for in the end.
  };

  // Four seconds through a shutter, tracked with what is said of it.
  static Outcome Follow(double readout, std::optional<double> given) {
    SharedMap map;
    Tracking::Options options;
    options.shutter.readout_seconds = given;
    Tracking tracking(options, World().camera(), SyntheticWorld::kBaselineTimesFx, Words(), map);
    LocalMapping mapping({}, World().camera(), SyntheticWorld::kBaselineTimesFx, Words(), map);
    constexpr int kNumFrames = 120;
    double sum = 0;
    for (int i = 0; i < kNumFrames; ++i) {
      const SyntheticView view = World().LookWhileRolling(i, Shaking, readout);
      const Tracking::Result result = tracking.Track(view.frame, {});
      EXPECT_EQ(result.state, TrackingState::kTracking) << "frame " << i;
      if (result.new_keyframe) mapping.Process(*result.new_keyframe, [] { return false; });
      const Rigid3 truth = Shaking(0).Inverse() * Shaking(i / 30.0);
      const double error = (result.T_world_camera.translation - truth.translation).norm();
      if (i >= kNumFrames - 30) sum += error * error;
    }
    return {std::sqrt(sum / 30), tracking.readout_seconds()};
  }
};

TEST_F(RollingShutterTest, ACorrectedFrameIsThatOfTheMiddleRow) {
  const SyntheticWorld exact(SyntheticWorld::Options{});
  const RollingShutter shutter({.readout_seconds = kReadout}, exact.camera(),
                               SyntheticWorld::kBaselineTimesFx);
  constexpr int kNumber = 10;
  const SyntheticView skewed = exact.LookWhileRolling(kNumber, Shaking, kReadout);
  constexpr double kStep = 1e-4;
  const double t = kNumber / 30.0;
  const Vector6d velocity = LocalDifference(Shaking(t - kStep), Shaking(t + kStep)) / (2 * kStep);
  const auto corrected = shutter.Correct(skewed.frame, velocity);
  float largest_skew = 0;
  ASSERT_EQ(corrected->keypoints.size(), skewed.points.size());
  for (std::size_t i = 0; i < skewed.points.size(); ++i) {
    const Eigen::Vector3d p_camera =
        skewed.T_world_camera.Inverse() * exact.p_world(skewed.points[i]);
    const Eigen::Vector2f truth = exact.camera().Project(p_camera).cast<float>();
    const Keypoint& keypoint = corrected->keypoints[i];
    largest_skew = std::max(largest_skew, (skewed.frame->keypoints[i].pixel - truth).norm());
    ASSERT_LT((keypoint.pixel - truth).norm(), 0.15F);
    ASSERT_NEAR(keypoint.depth, p_camera.z(), 1e-3);
    ASSERT_NEAR(keypoint.right_x,
                keypoint.pixel.x() - SyntheticWorld::kBaselineTimesFx / keypoint.depth, 1e-3);
    ASSERT_EQ(keypoint.raw_pixel, skewed.frame->keypoints[i].raw_pixel);
  }
  EXPECT_GT(largest_skew, 2);
}

TEST_F(RollingShutterTest, AGlobalShutterLeavesFramesAsTheyAre) {
  const RollingShutter shutter({.readout_seconds = 0.0}, World().camera(),
                               SyntheticWorld::kBaselineTimesFx);
  const auto frame = World().LookAlongPath(3).frame;
  EXPECT_EQ(shutter.Correct(frame, Vector6d::Ones()), frame);
}

TEST_F(RollingShutterTest, CorrectionHalvesTheErrorAtLeast) {
  const double uncorrected = Follow(kReadout, 0.0).rms_error;
  const Outcome corrected = Follow(kReadout, kReadout);
  EXPECT_EQ(corrected.readout, kReadout);
  EXPECT_LT(corrected.rms_error, 0.5 * uncorrected) << "uncorrected " << uncorrected;
}

TEST_F(RollingShutterTest, ReadoutTimeIsFoundWhileTracking) {
  for (const double readout : {kReadout, -kReadout}) {
    const Outcome outcome = Follow(readout, std::nullopt);
    EXPECT_NEAR(outcome.readout, readout, 0.2 * kReadout);
    EXPECT_LT(outcome.rms_error, 0.7 * Follow(readout, 0.0).rms_error);
  }
}

TEST_F(RollingShutterTest, AGlobalShutterIsTakenForOne) {
  EXPECT_EQ(Follow(0, std::nullopt).readout, 0);
}

TEST_F(RollingShutterTest, RefusesReadoutsLongerThanAFrame) {
  EXPECT_THROW(RollingShutter({.readout_seconds = 26.0}, World().camera(), 40), std::logic_error);
}

}  // namespace
}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/eval/trajectory_error.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semslam/base/random.h"

#include "support/files.h"

namespace semslam {
namespace {

using ::testing::HasSubstr;
using testing::InputErrorOf;

constexpr TimeNs kStep = 33'333'333;
constexpr double kDegree = 3.14159265358979323846 / 180.0;

// A smooth path in space that turns on the way.
Trajectory SmoothPath(int num_poses) {
  Trajectory path;
  for (int i = 0; i < num_poses; ++i) {
    const double s = 0.05 * i;
    path.push_back({i * kStep,
                    {ExpSO3({0.3 * std::sin(s), 0.2 * s, 0.1 * std::cos(s)}),
                     {std::cos(s), std::sin(s), 0.1 * s}}});
  }
  return path;
}

Trajectory Moved(const Rigid3& T_new_world, Trajectory path) {
  for (TimedPose& pose : path) pose.T_world_camera = T_new_world * pose.T_world_camera;
  return path;
}

const Rigid3 kSomeMotion{ExpSO3({0.4, -1.2, 0.7}), {3, -2, 5}};

TEST(TrajectoryError, IsZeroForTheSamePathInAnotherFrame) {
  const Trajectory truth = SmoothPath(100);
  const TrajectoryError error = EvaluateTrajectory(truth, Moved(kSomeMotion.Inverse(), truth));
  EXPECT_EQ(error.num_pairs, 100);
  EXPECT_LT(error.absolute.max, 1e-9);
  EXPECT_LT(error.relative_translation_rmse, 1e-9);
  EXPECT_LT(error.relative_rotation_rmse_degrees, 1e-6);
  EXPECT_LT((error.T_truth_estimate.translation - kSomeMotion.translation).norm(), 1e-9);
  EXPECT_LT(RotationAngle(error.T_truth_estimate, kSomeMotion), 1e-9);
}

// 20 cm long and hardly bent, with 2 mm of noise in the positions and none in the orientations: the
// positions alone leave the rotation about the path open.
TEST(TrajectoryError, AShortPathIsAlignedByItsOrientations) {
  Trajectory truth;
  Random random(1);
  for (int i = 0; i < 30; ++i) {
    const double s = i / 29.0;
    truth.push_back({i * kStep, {ExpSO3({0.1 * s, 0, 0}), {0.2 * s, 0.004 * s * s, 0}}});
  }
  Trajectory estimate = Moved(kSomeMotion.Inverse(), truth);
  for (TimedPose& pose : estimate) {
    for (int axis = 0; axis < 3; ++axis) {
      pose.T_world_camera.translation[axis] += 0.002 * random.Gaussian();
    }
  }
  const TrajectoryError error = EvaluateTrajectory(truth, estimate);
  EXPECT_LT(RotationAngle(error.T_truth_estimate_map, kSomeMotion), 0.002);
  EXPECT_GT(RotationAngle(error.T_truth_estimate, kSomeMotion), 0.02);
}

TEST(TrajectoryError, MeasuresDistancesThatNoAlignmentRemoves) {
  // A square whose corners are lifted and lowered in turns by 0.1: the best alignment is none.
  Trajectory truth;
  Trajectory estimate;
  const double x[] = {1, -1, -1, 1};
  const double y[] = {1, 1, -1, -1};
  for (int i = 0; i < 4; ++i) {
    truth.push_back({i * kStep, {Eigen::Quaterniond::Identity(), {x[i], y[i], 0}}});
    estimate.push_back(
        {i * kStep, {Eigen::Quaterniond::Identity(), {x[i], y[i], i % 2 == 0 ? 0.1 : -0.1}}});
  }
  const TrajectoryError error = EvaluateTrajectory(truth, estimate);
  EXPECT_NEAR(error.absolute.rmse, 0.1, 1e-12);
  EXPECT_NEAR(error.absolute.mean, 0.1, 1e-12);
  EXPECT_NEAR(error.absolute.median, 0.1, 1e-12);
  EXPECT_NEAR(error.absolute.max, 0.1, 1e-12);
  EXPECT_NEAR(error.path_length, 6.0, 1e-12);
}

TEST(TrajectoryError, MeasuresDriftOverOneSecond) {
  // Each step is too long by 1 mm and turns 0.01 degrees too far, about the axis it moves along:
  // over the 31 steps that are more than a second, 31 mm and 0.31 degrees.
  Trajectory truth;
  Trajectory estimate;
  for (int i = 0; i < 99; ++i) {
    truth.push_back({i * kStep, {Eigen::Quaterniond::Identity(), {0.01 * i, 0, 0}}});
    estimate.push_back({i * kStep, {ExpSO3({i * 0.01 * kDegree, 0, 0}), {0.011 * i, 0, 0}}});
  }
  // Far off the line, so that an alignment exists, and much later.
  truth.push_back({200 * kStep, {Eigen::Quaterniond::Identity(), {0, 1, 0}}});
  estimate.push_back({200 * kStep, {Eigen::Quaterniond::Identity(), {0, 1, 0}}});
  const TrajectoryError error = EvaluateTrajectory(truth, estimate);
  EXPECT_EQ(error.num_relative_pairs, 99 - 31);
  EXPECT_NEAR(error.relative_translation_rmse, 0.031, 1e-9);
  EXPECT_NEAR(error.relative_rotation_rmse_degrees, 0.31, 1e-6);
}

TEST(TrajectoryError, TakesTheNearestTruePoseInTime) {
  const Trajectory path = SmoothPath(50);
  Trajectory truth;
  for (const TimedPose& pose : path) {
    TimedPose wrong = pose;
    wrong.time += 12'000'000;
    wrong.T_world_camera.translation.x() += 1.0;
    truth.push_back({pose.time - 5'000'000, pose.T_world_camera});
    truth.push_back(wrong);
  }
  EXPECT_LT(EvaluateTrajectory(truth, path).absolute.max, 1e-9);
}

TEST(TrajectoryError, LeavesOutEstimatesWithoutATruePoseNearInTime) {
  Trajectory truth = SmoothPath(50);
  const Trajectory estimate = truth;
  for (TimedPose& pose : truth) {
    if (pose.time >= 25 * kStep) pose.time += 21'000'000 + kStep * 100;
  }
  EXPECT_EQ(EvaluateTrajectory(truth, estimate).num_pairs, 25);
}

TEST(TrajectoryError, SaysThatTooFewPosesAreNearInTime) {
  const Trajectory truth = SmoothPath(10);
  Trajectory late = truth;
  for (TimedPose& pose : late) pose.time += kNsPerSecond * 10;
  EXPECT_THAT(InputErrorOf([&] { EvaluateTrajectory(truth, late); }),
              HasSubstr("within 0.020 s, found 0 of 10 (10 true poses)"));
  EXPECT_THAT(InputErrorOf([&] { EvaluateTrajectory({}, late); }), HasSubstr("(0 true poses)"));
}

TEST(TrajectoryError, SaysThatPositionsOnALineDetermineNoAlignment) {
  Trajectory line;
  for (int i = 0; i < 10; ++i) {
    line.push_back({i * kStep, {Eigen::Quaterniond::Identity(), {1.0 * i, 0, 0}}});
  }
  EXPECT_THAT(InputErrorOf([&] { EvaluateTrajectory(line, line); }), HasSubstr("on one line"));
}

TEST(TrajectoryError, GrowsWithTheNoise) {
  // Independent noise of 1 cm on every axis: rmse sqrt(3) cm, but for what the six parameters of
  // the alignment take away.
  const Trajectory truth = SmoothPath(2000);
  Trajectory estimate = truth;
  Random random(1);
  for (TimedPose& pose : estimate) {
    for (int axis = 0; axis < 3; ++axis) {
      pose.T_world_camera.translation[axis] += 0.01 * random.Gaussian();
    }
  }
  EXPECT_NEAR(EvaluateTrajectory(truth, estimate).absolute.rmse, 0.01 * std::sqrt(3.0), 3e-4);
}

}  // namespace
}  // namespace semslam

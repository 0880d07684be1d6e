// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/optim/pose_optimizer.h"

#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "optim/synthetic_bundle.h"

namespace semslam {
namespace {

using testing::MakePoseScene;
using testing::Noise;
using testing::PoseScene;

// As far off as a bad constant-velocity prediction.
Rigid3 Off(const Rigid3& T_world_camera) {
  Random random(77);
  return Retract(T_world_camera, testing::RandomTwist(0.05, 0.1, &random));
}

double Distance(const Rigid3& a, const Rigid3& b) { return (a.translation - b.translation).norm(); }

PoseSolution Solve(const PoseScene& scene) {
  return OptimizePose(scene.camera, Off(scene.T_world_camera), scene.observations);
}

// Without noise only rounding remains.
constexpr double kExact = 1e-9;

class PoseOptimizerWithDepthFraction : public ::testing::TestWithParam<double> {};

TEST_P(PoseOptimizerWithDepthFraction, RecoversThePoseExactlyFromExactMeasurements) {
  const PoseScene scene = MakePoseScene(300, {.with_depth = GetParam()});
  const PoseSolution solution = Solve(scene);
  EXPECT_EQ(solution.num_inliers, 300);
  EXPECT_LT(Distance(solution.T_world_camera, scene.T_world_camera), kExact);
  EXPECT_LT(RotationAngle(solution.T_world_camera, scene.T_world_camera), kExact);
}

TEST_P(PoseOptimizerWithDepthFraction, FindsTheOutliersAndThePoseAmongThirtyPercent) {
  const PoseScene scene =
      MakePoseScene(600, {.pixel = 0.5, .outliers = 0.3, .with_depth = GetParam()});
  const PoseSolution solution = Solve(scene);
  int num_wrong = 0;
  for (std::size_t i = 0; i < scene.is_outlier.size(); ++i) {
    num_wrong += solution.is_inlier[i] == scene.is_outlier[i];
  }
  // An outlier that hits the true place by chance; the noise is half of what the limits allow.
  EXPECT_LE(num_wrong, 6);
  EXPECT_LT(Distance(solution.T_world_camera, scene.T_world_camera), 0.003);
}

INSTANTIATE_TEST_SUITE_P(NoneSomeAll,
                         PoseOptimizerWithDepthFraction,
                         ::testing::Values(0.0, 0.5, 1.0));

// The error of the solution, weighed with the normal equations of the exact pose, follows a chi-
// squared distribution of 6 degrees of freedom; so does, by its mean, the sum over many seeds.
TEST(PoseOptimizer, ErrorsAreAsLargeAsTheCovarianceSays) {
  constexpr int kNumScenes = 100;
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= kNumScenes; ++seed) {
    const PoseScene scene = MakePoseScene(200, {.pixel = 1.0, .seed = seed});
    PoseOptions all_inliers;
    all_inliers.chi2 = {.without_depth = 100, .with_depth = 100};
    const PoseSolution solution =
        OptimizePose(scene.camera, Off(scene.T_world_camera), scene.observations, all_inliers);
    Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
    for (const PoseObservation& o : scene.observations) {
      // Central differences of the measurement by the pose.
      Eigen::Matrix<double, 3, 6> jacobian = Eigen::Matrix<double, 3, 6>::Zero();
      for (int i = 0; i < 6; ++i) {
        const Vector6d step = 1e-6 * Vector6d::Unit(i);
        const auto measure = [&](const Vector6d& delta) {
          const ImagePoint image = testing::Observe(
              scene.camera, Retract(scene.T_world_camera, delta).Inverse() * o.p_world, true);
          return Eigen::Vector3d(image.pixel.x(), image.pixel.y(),
                                 o.image.has_right() ? image.right_x : 0.0);
        };
        jacobian.col(i) = (measure(step) - measure(-step)) / 2e-6;
      }
      information += o.image.inverse_variance * jacobian.transpose() * jacobian;
    }
    const Vector6d error = LocalDifference(scene.T_world_camera, solution.T_world_camera);
    sum += error.dot(information * error);
  }
  // Standard deviation of the mean: sqrt(12 / 100) = 0.35.
  EXPECT_NEAR(sum / kNumScenes, 6.0, 1.2);
}

TEST(PoseOptimizer, MeanSquaredErrorOfInliersIsThatOfTheNoise) {
  const PoseScene scene = MakePoseScene(2000, {.pixel = 1.0, .with_depth = 1.0});
  // Three numbers of variance 1 each, less the 5 % in the tail of the distribution.
  const PoseSolution solution = Solve(scene);
  EXPECT_NEAR(solution.num_inliers, 1900, 40);
  EXPECT_NEAR(solution.mean_chi2, 2.6, 0.15);
}

TEST(PoseOptimizer, TakesBackAnObservationThatTheFirstRoundsThrewOut) {
  // From so far off that one round of two iterations leaves good observations outside the limits.
  const PoseScene scene = MakePoseScene(300, {});
  PoseOptions one_round{.num_rounds = 1, .iterations_per_round = 2};
  PoseOptions four_rounds{.num_rounds = 4, .iterations_per_round = 2};
  Random random(3);
  const Rigid3 far = Retract(scene.T_world_camera, testing::RandomTwist(0.4, 0.4, &random));
  const PoseSolution first = OptimizePose(scene.camera, far, scene.observations, one_round);
  ASSERT_LT(first.num_inliers, 300);
  EXPECT_EQ(OptimizePose(scene.camera, far, scene.observations, four_rounds).num_inliers, 300);
}

TEST(PoseOptimizer, PointsBehindTheCameraAreOutliers) {
  PoseScene scene = MakePoseScene(100, {});
  // The mirror image of a point projects to the same pixel.
  const Eigen::Vector3d p_camera = scene.T_world_camera.Inverse() * scene.observations[0].p_world;
  scene.observations[0].p_world = scene.T_world_camera * Eigen::Vector3d(-p_camera);
  scene.observations[0].image.right_x = kNoRightX;
  const PoseSolution solution = Solve(scene);
  EXPECT_EQ(solution.is_inlier[0], 0);
  EXPECT_EQ(solution.num_inliers, 99);
}

TEST(PoseOptimizer, KeepsTheInitialPoseWhenAllPointsAreBehind) {
  PoseScene scene = MakePoseScene(100, {});
  const Rigid3 turned =
      scene.T_world_camera * Rigid3{ExpSO3({0, std::numbers::pi, 0}), Eigen::Vector3d::Zero()};
  const PoseSolution solution = OptimizePose(scene.camera, turned, scene.observations);
  EXPECT_EQ(solution.num_inliers, 0);
  EXPECT_EQ(solution.T_world_camera.ToMatrix(), turned.ToMatrix());
  EXPECT_EQ(solution.is_inlier, std::vector<std::uint8_t>(100, 0));
}

class PoseOptimizerWithFew : public ::testing::TestWithParam<int> {};

TEST_P(PoseOptimizerWithFew, KeepsTheInitialPoseWithoutInliers) {
  PoseScene scene = MakePoseScene(GetParam(), {});
  const Rigid3 initial = Off(scene.T_world_camera);
  const PoseSolution solution = OptimizePose(scene.camera, initial, scene.observations);
  EXPECT_EQ(solution.num_inliers, 0);
  EXPECT_EQ(solution.is_inlier.size(), scene.observations.size());
  EXPECT_EQ(solution.T_world_camera.ToMatrix(), initial.ToMatrix());
}

INSTANTIATE_TEST_SUITE_P(FewerThanThree, PoseOptimizerWithFew, ::testing::Values(0, 1, 2));

TEST(PoseOptimizer, ThreePointsWithDepthAreEnough) {
  const PoseScene scene = MakePoseScene(3, {.with_depth = 1.0});
  const PoseSolution solution = Solve(scene);
  EXPECT_EQ(solution.num_inliers, 3);
  EXPECT_LT(Distance(solution.T_world_camera, scene.T_world_camera), 1e-6);
}

TEST(PoseOptimizer, StaysFiniteWhenAllObservationsAreOfOnePoint) {
  PoseScene scene = MakePoseScene(1, {.with_depth = 1.0});
  scene.observations.resize(50, scene.observations[0]);
  const PoseSolution solution = Solve(scene);
  EXPECT_TRUE(solution.T_world_camera.ToMatrix().allFinite());
  EXPECT_EQ(solution.num_inliers, 50);
}

TEST(PoseOptimizer, NumbersThatAreNotFiniteAreOutliers) {
  PoseScene scene = MakePoseScene(100, {});
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  scene.observations[0].p_world.x() = kNan;
  scene.observations[1].image.pixel.y() = kNan;
  scene.observations[2].image.right_x = kNan;
  scene.observations[3].image.inverse_variance = std::numeric_limits<double>::infinity();
  const PoseSolution solution = Solve(scene);
  EXPECT_EQ(solution.num_inliers, 96);
  EXPECT_LT(Distance(solution.T_world_camera, scene.T_world_camera), kExact);
}

TEST(PoseOptimizer, GivesTheSameBitsTwice) {
  const PoseScene scene = MakePoseScene(600, {.pixel = 1.0, .outliers = 0.2});
  EXPECT_EQ(Solve(scene).T_world_camera.ToMatrix(), Solve(scene).T_world_camera.ToMatrix());
}

TEST(PoseOptimizer, RefusesOptionsThatMakeNoSense) {
  EXPECT_THROW(PoseOptions{.num_rounds = 0}.Validate(), std::logic_error);
  EXPECT_THROW(PoseOptions{.iterations_per_round = 0}.Validate(), std::logic_error);
}

}  // namespace
}  // namespace semslam

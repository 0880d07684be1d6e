// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/optim/bundle_adjuster.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "optim/synthetic_bundle.h"

namespace semslam {
namespace {

using testing::BundleScene;
using testing::Disturbed;
using testing::MakeBundleScene;
using testing::Noise;

// As far off as a map is after tracking.
constexpr double kAngleOff = 0.01;
constexpr double kDistanceOff = 0.03;

BundleProblem Disturb(const BundleScene& scene) {
  return Disturbed(scene.problem, kAngleOff, kDistanceOff, 5);
}

double MaxPoseDistance(const std::vector<Rigid3>& a, const std::vector<Rigid3>& b) {
  double distance = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    distance = std::max(
        {distance, (a[i].translation - b[i].translation).norm(), RotationAngle(a[i], b[i])});
  }
  return distance;
}

double MedianPointDistance(const std::vector<Eigen::Vector3d>& a,
                           const std::vector<Eigen::Vector3d>& b) {
  std::vector<double> distances;
  for (std::size_t i = 0; i < a.size(); ++i) distances.push_back((a[i] - b[i]).norm());
  std::nth_element(distances.begin(), distances.begin() + distances.size() / 2, distances.end());
  return distances[distances.size() / 2];
}

class BundleAdjusterWithDepthFraction : public ::testing::TestWithParam<double> {};

TEST_P(BundleAdjusterWithDepthFraction, RecoversPosesAndPointsFromExactMeasurements) {
  const BundleScene scene = MakeBundleScene(8, 2, 300, 6, {.with_depth = GetParam()});
  const BundleSolution solution = AdjustBundle(Disturb(scene), {.plain_iterations = 30});
  EXPECT_LT(MaxPoseDistance(solution.T_world_camera, scene.problem.T_world_camera), 1e-6);
  EXPECT_LT(MedianPointDistance(solution.p_world, scene.problem.p_world), 1e-6);
}

TEST_P(BundleAdjusterWithDepthFraction, FindsTheOutliersAmongThirtyPercent) {
  // Points seen some fifteen times each, so that the good observations outvote the others.
  const BundleScene scene =
      MakeBundleScene(24, 6, 400, 20, {.pixel = 0.5, .outliers = 0.3, .with_depth = GetParam()});
  const BundleSolution solution = AdjustBundle(Disturb(scene));
  int num_missed = 0;
  int num_lost = 0;
  for (std::size_t i = 0; i < scene.is_outlier.size(); ++i) {
    num_missed += scene.is_outlier[i] && solution.is_inlier[i];
    num_lost += !scene.is_outlier[i] && !solution.is_inlier[i];
  }
  const double num_observations = static_cast<double>(scene.is_outlier.size());
  EXPECT_LT(num_missed, 0.01 * num_observations);
  EXPECT_LT(num_lost, 0.03 * num_observations);

  // The poses are about as good as without any outliers.
  BundleProblem inliers = scene.problem;
  inliers.observations.clear();
  for (std::size_t i = 0; i < scene.is_outlier.size(); ++i) {
    if (!scene.is_outlier[i]) inliers.observations.push_back(scene.problem.observations[i]);
  }
  const std::vector<Rigid3>& truth = scene.problem.T_world_camera;
  EXPECT_LT(MaxPoseDistance(solution.T_world_camera, truth),
            1.5 * MaxPoseDistance(AdjustBundle(inliers).T_world_camera, truth));
}

INSTANTIATE_TEST_SUITE_P(NoneSomeAll,
                         BundleAdjusterWithDepthFraction,
                         ::testing::Values(0.0, 0.5, 1.0));

TEST(BundleAdjuster, WithNoiseTheCostIsThatOfTheNoise) {
  const BundleScene scene = MakeBundleScene(10, 2, 500, 8, {.pixel = 1.0, .with_depth = 1.0});
  const BundleSolution solution = AdjustBundle(Disturb(scene));
  // Three numbers an observation, less six a free pose and three a point; the kernel takes a
  // little off the tail.
  const double expected =
      3.0 * static_cast<double>(scene.problem.observations.size()) - 6 * 8 - 3 * 500;
  EXPECT_NEAR(solution.final_cost / expected, 1.0, 0.05);
  EXPECT_LT(solution.final_cost, solution.initial_cost);
}

TEST(BundleAdjuster, FixedPosesDoNotMoveByABit) {
  const BundleScene scene = MakeBundleScene(8, 3, 200, 6, {.pixel = 1.0});
  const BundleProblem problem = Disturb(scene);
  const BundleSolution solution = AdjustBundle(problem);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(solution.T_world_camera[i].rotation.coeffs(),
              problem.T_world_camera[i].rotation.coeffs());
    EXPECT_EQ(solution.T_world_camera[i].translation, problem.T_world_camera[i].translation);
  }
}

TEST(BundleAdjuster, WithAllPosesFixedOnlyPointsMove) {
  const BundleScene scene = MakeBundleScene(6, 6, 100, 6, {.with_depth = 1.0});
  const BundleSolution solution = AdjustBundle(Disturb(scene));
  EXPECT_EQ(MaxPoseDistance(solution.T_world_camera, scene.problem.T_world_camera), 0.0);
  EXPECT_LT(MedianPointDistance(solution.p_world, scene.problem.p_world), 1e-6);
}

TEST(BundleAdjuster, PointsWithoutObservationsStay) {
  BundleScene scene = MakeBundleScene(6, 2, 100, 6, {});
  scene.problem.p_world.emplace_back(1, 2, 3);
  const BundleSolution solution = AdjustBundle(scene.problem);
  EXPECT_EQ(solution.p_world.back(), Eigen::Vector3d(1, 2, 3));
}

TEST(BundleAdjuster, PosesWithoutObservationsStay) {
  BundleScene scene = MakeBundleScene(6, 2, 100, 6, {});
  const Rigid3 lonely{ExpSO3({0.1, 0.2, 0.3}), {1, 2, 3}};
  scene.problem.T_world_camera.push_back(lonely);
  scene.problem.pose_is_fixed.push_back(0);
  const BundleSolution solution = AdjustBundle(scene.problem);
  EXPECT_LT((solution.T_world_camera.back().ToMatrix() - lonely.ToMatrix()).norm(), 1e-12);
}

TEST(BundleAdjuster, AcceptsAnEmptyProblem) {
  const BundleSolution solution = AdjustBundle(BundleProblem{.camera = testing::TestCamera()});
  EXPECT_TRUE(solution.T_world_camera.empty());
  EXPECT_EQ(solution.final_cost, 0.0);
}

TEST(BundleAdjuster, ObservationsBehindTheCameraAreOutliersAndDoNoHarm) {
  BundleScene scene = MakeBundleScene(8, 2, 200, 6, {});
  const int behind = static_cast<int>(scene.problem.p_world.size());
  scene.problem.p_world.emplace_back(1, 0, -3);
  for (int pose = 0; pose < 8; ++pose) {
    scene.problem.observations.push_back({pose, behind, {.pixel = {320, 240}, .right_x = 300}});
  }
  BundleProblem problem = Disturb(scene);
  const BundleSolution solution = AdjustBundle(problem, {.plain_iterations = 30});
  for (std::size_t i = scene.problem.observations.size() - 8; i < solution.is_inlier.size(); ++i) {
    EXPECT_EQ(solution.is_inlier[i], 0);
  }
  EXPECT_EQ(solution.p_world.back(), problem.p_world.back());
  EXPECT_LT(MaxPoseDistance(solution.T_world_camera, scene.problem.T_world_camera), 1e-6);
}

TEST(BundleAdjuster, APoseMayHaveSeenAPointTwice) {
  BundleScene scene = MakeBundleScene(6, 2, 100, 6, {});
  for (std::size_t i = 0; i < 200; ++i) {
    scene.problem.observations.push_back(scene.problem.observations[i]);
  }
  const BundleSolution solution = AdjustBundle(Disturb(scene), {.plain_iterations = 30});
  EXPECT_LT(MaxPoseDistance(solution.T_world_camera, scene.problem.T_world_camera), 1e-6);
}

TEST(BundleAdjuster, StoppedBeforeTheFirstIterationItChangesNothing) {
  const BundleProblem problem = Disturb(MakeBundleScene(6, 2, 100, 6, {}));
  const BundleSolution solution = AdjustBundle(problem, {.should_stop = [] { return true; }});
  EXPECT_TRUE(solution.stopped);
  EXPECT_EQ(solution.num_iterations, 0);
  EXPECT_EQ(solution.p_world, problem.p_world);
  EXPECT_EQ(solution.is_inlier.size(), problem.observations.size());
}

TEST(BundleAdjuster, StoppedOnTheWayItKeepsWhatItHasReached) {
  const BundleProblem problem = Disturb(MakeBundleScene(10, 2, 300, 6, {.pixel = 1.0}));
  int num_asked = 0;
  const BundleSolution solution =
      AdjustBundle(problem, {.should_stop = [&] { return ++num_asked > 2; }});
  EXPECT_TRUE(solution.stopped);
  EXPECT_EQ(solution.num_iterations, 2);
  EXPECT_LT(solution.final_cost, 0.5 * solution.initial_cost);
}

TEST(BundleAdjuster, GivesTheSameBitsOnAnyNumberOfThreads) {
  const BundleProblem problem =
      Disturb(MakeBundleScene(12, 2, 1500, 6, {.pixel = 1.0, .outliers = 0.1}));
  const BundleSolution one = AdjustBundle(problem, {.num_threads = 1});
  const BundleSolution three = AdjustBundle(problem, {.num_threads = 3});
  EXPECT_EQ(one.p_world, three.p_world);
  EXPECT_EQ(one.final_cost, three.final_cost);
}

TEST(BundleAdjuster, RefusesBrokenProblems) {
  const BundleProblem good = MakeBundleScene(4, 1, 20, 6, {}).problem;
  BundleProblem wrong_pose = good;
  wrong_pose.observations[3].pose = 4;
  EXPECT_THROW(AdjustBundle(wrong_pose), std::logic_error);
  BundleProblem wrong_point = good;
  wrong_point.observations[3].point = -1;
  EXPECT_THROW(AdjustBundle(wrong_point), std::logic_error);
  BundleProblem wrong_flags = good;
  wrong_flags.pose_is_fixed.pop_back();
  EXPECT_THROW(AdjustBundle(wrong_flags), std::logic_error);
  BundleProblem not_finite = good;
  not_finite.p_world[0].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(AdjustBundle(not_finite), std::logic_error);
}

}  // namespace
}  // namespace semslam

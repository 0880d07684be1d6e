// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "semslam/optim/bundle_adjuster.h"
#include "semslam/optim/pose_optimizer.h"

#include "optim/ceres_reference.h"
#include "optim/synthetic_bundle.h"

namespace semslam {
namespace {

using testing::CeresSolution;

constexpr double kAgreement = 1e-6;  // Metres and radians.
// No observation is an outlier: kernel or not, the cost is the same.
constexpr Chi2Limits kNoLimits = {.without_depth = 1e5, .with_depth = 1e5};

void ExpectAgreement(const BundleSolution& ours, const CeresSolution& theirs) {
  for (std::size_t i = 0; i < ours.T_world_camera.size(); ++i) {
    const Rigid3& a = ours.T_world_camera[i];
    const Rigid3& b = theirs.T_world_camera[i];
    EXPECT_LT((a.translation - b.translation).norm(), kAgreement) << "pose " << i;
    EXPECT_LT(RotationAngle(a, b), kAgreement) << "pose " << i;
  }
  for (std::size_t i = 0; i < ours.p_world.size(); ++i) {
    EXPECT_LT((ours.p_world[i] - theirs.p_world[i]).norm(), kAgreement) << "point " << i;
  }
}

// Points that nothing but two views along one line fix would agree to fewer digits.
BundleProblem WithWellObservedPoints(const testing::BundleScene& scene) {
  BundleProblem problem = scene.problem;
  std::vector<int> num_observations(problem.p_world.size());
  for (const auto& observation : problem.observations) ++num_observations[observation.point];
  std::erase_if(problem.observations, [&](const BundleProblem::Observation& observation) {
    return num_observations[observation.point] < 4;
  });
  return testing::Disturbed(problem, 0.01, 0.02, 3);
}

TEST(CeresAgreement, BundleWithoutKernelHasTheSameMinimum) {
  const BundleProblem problem = WithWellObservedPoints(
      testing::MakeBundleScene(8, 2, 200, 6, {.pixel = 1.0, .with_depth = 0.7}));
  const BundleSolution ours = AdjustBundle(problem, {.robust_iterations = 0,
                                                     .plain_iterations = 100,
                                                     .chi2 = kNoLimits,
                                                     .relative_tolerance = 0});
  const CeresSolution theirs = testing::SolveWithCeres(problem, kNoLimits, {});
  ExpectAgreement(ours, theirs);
  EXPECT_NEAR(ours.final_cost, theirs.cost, 1e-9 * theirs.cost);
}

TEST(CeresAgreement, BundleWithKernelHasTheSameMinimum) {
  const BundleProblem problem = WithWellObservedPoints(
      testing::MakeBundleScene(8, 2, 200, 6, {.pixel = 1.0, .outliers = 0.02, .with_depth = 1.0}));
  const BundleSolution ours = AdjustBundle(
      problem, {.robust_iterations = 500, .plain_iterations = 0, .relative_tolerance = 0});
  const CeresSolution theirs = testing::SolveWithCeres(problem, {}, {.robust = true});
  ExpectAgreement(ours, theirs);
  EXPECT_NEAR(ours.final_cost, theirs.cost, 1e-9 * theirs.cost);
}

TEST(CeresAgreement, ManyPosesGoThroughTheSparseSolverToTheSameMinimum) {
  const BundleProblem problem = WithWellObservedPoints(
      testing::MakeBundleScene(70, 2, 700, 6, {.pixel = 1.0, .with_depth = 1.0, .pyramid = false}));
  const BundleSolution ours = AdjustBundle(problem, {.robust_iterations = 0,
                                                     .plain_iterations = 100,
                                                     .chi2 = kNoLimits,
                                                     .relative_tolerance = 0});
  ExpectAgreement(ours, testing::SolveWithCeres(problem, kNoLimits, {}));
}

TEST(CeresAgreement, PoseOnlyHasTheSameMinimum) {
  const testing::PoseScene scene = testing::MakePoseScene(300, {.pixel = 1.0});
  const PoseSolution ours = OptimizePose(scene.camera, scene.T_world_camera, scene.observations,
                                         {.num_rounds = 1,
                                          .num_robust_rounds = 1,
                                          .iterations_per_round = 100,
                                          .relative_tolerance = 0});
  BundleProblem problem{
      .camera = scene.camera, .T_world_camera = {scene.T_world_camera}, .pose_is_fixed = {0}};
  for (const PoseObservation& observation : scene.observations) {
    problem.observations.push_back(
        {0, static_cast<int>(problem.p_world.size()), observation.image});
    problem.p_world.push_back(observation.p_world);
  }
  const CeresSolution theirs =
      testing::SolveWithCeres(problem, {}, {.robust = true, .fix_points = true});
  EXPECT_LT((ours.T_world_camera.translation - theirs.T_world_camera[0].translation).norm(),
            kAgreement);
  EXPECT_LT(RotationAngle(ours.T_world_camera, theirs.T_world_camera[0]), kAgreement);
}

}  // namespace
}  // namespace semslam

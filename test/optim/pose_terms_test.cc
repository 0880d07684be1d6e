// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "optim/pose_terms.h"

#include <gtest/gtest.h>

#include "optim/huber.h"
#include "optim/synthetic_bundle.h"

namespace semslam::internal {
namespace {

using testing::MakePoseScene;
using testing::PoseScene;

const Chi2Limits kLimits;

// One observation after the other.
PoseTerms::Linearization Expected(const PoseScene& scene,
                                  const Rigid3& T_world_camera,
                                  bool robust) {
  PoseTerms::Linearization result;
  for (const PoseObservation& observation : scene.observations) {
    const double limit = kLimits.Of(observation.image);
    const Eigen::Vector3d p_camera = T_world_camera.Inverse() * observation.p_world;
    if (!IsInFront(p_camera)) {
      result.cost += robust ? Huber(kBehindChi2, limit).cost : kBehindChi2;
      continue;
    }
    ReprojectionTerm term = LinearizeReprojection(scene.camera, p_camera, observation.image);
    const RobustCost huber = Huber(term.chi2, limit);
    result.cost += robust ? huber.cost : term.chi2;
    if (robust) term.Scale(huber.weight);
    result.equations.Add(term);
  }
  return result;
}

void ExpectSumsOfAll(const PoseScene& scene, const Rigid3& T_world_camera) {
  PoseTerms terms;
  for (const PoseObservation& observation : scene.observations)
    terms.Add(observation, kLimits.Of(observation.image));
  EXPECT_EQ(terms.size(), scene.observations.size());
  for (const bool robust : {false, true}) {
    const PoseTerms::Linearization expected = Expected(scene, T_world_camera, robust);
    const PoseTerms::Linearization sums = terms.Linearize(scene.camera, T_world_camera, robust);
    EXPECT_NEAR(sums.cost, expected.cost, 1e-12 * expected.cost);
    EXPECT_TRUE(sums.equations.Hessian().isApprox(expected.equations.Hessian(), 1e-11));
    EXPECT_TRUE(sums.equations.Gradient().isApprox(expected.equations.Gradient(), 1e-11));
  }
}

TEST(PoseTerms, SumTheTermsOfAnyNumberOfObservations) {
  for (int count = 1; count <= 13; ++count) {
    SCOPED_TRACE(count);
    const PoseScene scene =
        MakePoseScene(count, {.pixel = 1.0, .outliers = 0.3, .with_depth = 0.5});
    ExpectSumsOfAll(scene, scene.T_world_camera);
  }
}

TEST(PoseTerms, CountPointsBehindTheCameraWithoutLookingAtTheirPlace) {
  PoseScene scene = MakePoseScene(11, {.pixel = 1.0, .with_depth = 0.5});
  const Rigid3 T_camera_world = scene.T_world_camera.Inverse();
  for (const int behind : {1, 6, 10}) {
    const Eigen::Vector3d p_camera = T_camera_world * scene.observations[behind].p_world;
    scene.observations[behind].p_world = scene.T_world_camera * Eigen::Vector3d(-p_camera);
  }
  scene.observations[3].p_world = scene.T_world_camera.translation;  // Depth 0.
  ExpectSumsOfAll(scene, scene.T_world_camera);
}

TEST(PoseTerms, StartAnew) {
  const PoseScene scene = MakePoseScene(5, {.pixel = 1.0, .with_depth = 1.0});
  PoseTerms terms;
  terms.Add(scene.observations[0], 1.0);
  terms.Clear();
  EXPECT_EQ(terms.size(), 0u);
  EXPECT_EQ(terms.Linearize(scene.camera, scene.T_world_camera, true).cost, 0.0);
}

}  // namespace
}  // namespace semslam::internal

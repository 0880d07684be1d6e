// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/optim/readout_fit.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "optim/reprojection.h"
#include "optim/synthetic_bundle.h"

namespace semslam {
namespace {

using testing::MakePoseScene;
using testing::PoseScene;

// Measurements of a camera that turns to the right, freed from its rolling shutter with a readout
// time that is `missing` seconds too short.
std::vector<ReadoutObservation> TurningCamera(const PoseScene& scene, double missing) {
  constexpr double kSpeed = 300;  // Pixels a second.
  std::vector<ReadoutObservation> observations;
  for (const PoseObservation& seen : scene.observations) {
    const double shift = (seen.image.pixel.y() / 480 - 0.5) * kSpeed;
    ReadoutObservation& observation = observations.emplace_back();
    observation.point = seen;
    observation.rate = {shift, 0, seen.image.has_right() ? shift : 0};
    observation.point.image.pixel.x() -= shift * missing;
    if (seen.image.has_right()) observation.point.image.right_x -= shift * missing;
  }
  return observations;
}

TEST(ReadoutFit, FindsWhatIsMissingBesideAPoseThatIsOff) {
  const PoseScene scene = MakePoseScene(200, {});
  Vector6d off;
  off << 2e-4, -3e-4, 1e-4, 3e-4, 2e-4, -2e-4;
  for (const double missing : {0.0, 0.004, -0.002}) {
    const ReadoutFit fit =
        FitReadout(scene.camera, Retract(scene.T_world_camera, off), TurningCamera(scene, missing));
    EXPECT_NEAR(fit.correction, missing, 1e-4);
    EXPECT_GT(fit.information, 0);
  }
}

TEST(ReadoutFit, TellsItsOwnUncertainty) {
  constexpr int kNumScenes = 100;
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= kNumScenes; ++seed) {
    const PoseScene scene = MakePoseScene(200, {.pixel = 1, .seed = seed});
    const ReadoutFit fit =
        FitReadout(scene.camera, scene.T_world_camera, TurningCamera(scene, 0), {1e9, 1e9});
    sum += fit.correction * fit.correction * fit.information;
  }
  // Standard deviation of the mean: sqrt(2 / 100) = 0.14.
  EXPECT_NEAR(sum / kNumScenes, 1.0, 0.5);
}

TEST(ReadoutFit, WhatThePoseExplainsTellsNothing) {
  const PoseScene scene = MakePoseScene(200, {});
  std::vector<ReadoutObservation> observations;
  for (const PoseObservation& seen : scene.observations) {
    const Eigen::Vector3d p_camera = scene.T_world_camera.Inverse() * seen.p_world;
    const Eigen::Vector3d rate =
        internal::PoseJacobian(scene.camera, p_camera, seen.image.has_right()).col(4);
    observations.push_back({seen, rate});
  }
  double sum = 0;
  for (const ReadoutObservation& observation : observations) {
    sum += observation.point.image.inverse_variance * observation.rate.squaredNorm();
  }
  const ReadoutFit fit = FitReadout(scene.camera, scene.T_world_camera, observations);
  EXPECT_LT(fit.information, 1e-9 * sum);
}

TEST(ReadoutFit, OutliersHaveNoSay) {
  const PoseScene scene = MakePoseScene(200, {});
  std::vector<ReadoutObservation> observations = TurningCamera(scene, 0.003);
  observations[7].point.image.pixel.x() += 40;
  EXPECT_NEAR(FitReadout(scene.camera, scene.T_world_camera, observations).correction, 0.003, 1e-4);
}

TEST(ReadoutFit, NothingSeenTellsNothing) {
  EXPECT_EQ(FitReadout(testing::TestCamera(), Rigid3(), {}).information, 0);
}

}  // namespace
}  // namespace semslam

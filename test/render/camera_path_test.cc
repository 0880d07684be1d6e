// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/camera_path.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "semslam/render/scenes.h"

#include "support/matchers.h"

namespace semslam {
namespace {

using testing::Rigid3Near;

std::vector<Waypoint> Square() {
  return {{{0, 0, 1}, {0, 1, 1}},
          {{1, 0, 1}, {1, 1, 1}},
          {{1, 1, 1}, {1, 2, 1}},
          {{0, 1, 1}, {0, 2, 1}}};
}

TEST(CameraPath, LooksAtTheTargetWithALevelHorizon) {
  const std::vector<Waypoint> still(4, {{1, 2, 3}, {2, 4, 2.5}});
  const Rigid3 pose = CameraPath(still, {.sway_m = 0, .sway_angle = 0}).At(0.3);
  const Eigen::Vector3d p_camera = pose.Inverse() * Eigen::Vector3d(2, 4, 2.5);
  EXPECT_NEAR(p_camera.x(), 0, 1e-12);
  EXPECT_NEAR(p_camera.y(), 0, 1e-12);
  EXPECT_GT(p_camera.z(), 2);
  EXPECT_NEAR((pose.rotation * Eigen::Vector3d::UnitX()).z(), 0, 1e-12);
  EXPECT_LT((pose.rotation * Eigen::Vector3d::UnitY()).z(), -0.9);  // Down.
}

TEST(CameraPath, ClosedPathComesBack) {
  const CameraPath path(Square(), {.seconds_per_waypoint = 0.5, .sway_m = 0, .sway_angle = 0});
  EXPECT_THAT(path.At(0.7 + 2.0), Rigid3Near(path.At(0.7), 1e-9, 1e-9));
}

TEST(CameraPath, OpenPathStopsAtItsEnd) {
  const CameraPath path(Square(), {.closed = false, .sway_m = 0, .sway_angle = 0});
  EXPECT_THAT(path.At(50), Rigid3Near(path.At(3), 1e-9, 1e-9));
}

TEST(CameraPath, HasNoJumpsOfAcceleration) {
  const CameraPath path(Square(), {});
  constexpr double kStep = 1e-3;
  const auto acceleration = [&](double time) {
    return Eigen::Vector3d((path.At(time + kStep).translation - 2 * path.At(time).translation +
                            path.At(time - kStep).translation) /
                           (kStep * kStep));
  };
  double largest_jump = 0;
  for (double time = 0.1; time < 4; time += 0.004) {
    largest_jump = std::max(largest_jump, (acceleration(time + 0.004) - acceleration(time)).norm());
  }
  EXPECT_LT(largest_jump, 0.05);  // m/s^2 in 4 ms.
}

TEST(CameraPath, DeskIsSweptAtTheSpeedOfAHand) {
  const StagedScene desk = MakeScene("desk", 1);
  double fastest = 0;
  double fastest_turn = 0;
  for (int i = 1; i < 400; ++i) {
    const Rigid3 before = desk.path.At((i - 1) / 30.0);
    const Rigid3 after = desk.path.At(i / 30.0);
    fastest = std::max(fastest, 30 * (after.translation - before.translation).norm());
    fastest_turn = std::max(fastest_turn, 30 * RotationAngle(before, after));
  }
  EXPECT_GT(fastest, 0.2);
  EXPECT_LT(fastest, 0.5);  // m/s
  EXPECT_GT(fastest_turn, 0.1);
  EXPECT_LT(fastest_turn, 0.6);  // rad/s
}

}  // namespace
}  // namespace semslam

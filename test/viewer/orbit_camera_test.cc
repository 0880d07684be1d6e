// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/viewer/orbit_camera.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace semslam {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr double kRightAngle = 0.5 * std::numbers::pi;

Eigen::Vector3f ViewDirectionOf(const OrbitCamera& camera) {
  return camera.At(kWidth, kHeight).R_camera_world.row(2);
}

TEST(OrbitCameraTest, TheTargetIsInTheMiddleOfThePicture) {
  OrbitCamera orbit;
  orbit.SetDirection(0.7, 0.4);
  orbit.LookAt({1, -2, 3}, 2.5);
  const ViewCamera camera = orbit.At(kWidth, kHeight);
  const Eigen::Vector3f p_camera = camera.ToCamera({1, -2, 3});
  EXPECT_NEAR(p_camera.z(), 2.5, 1e-5);
  EXPECT_NEAR((camera.Project(p_camera) - Eigen::Vector2f(319.5F, 239.5F)).norm(), 0, 1e-2);
}

TEST(OrbitCameraTest, ItLooksForwardAtAzimuthZeroAndStaysUpright) {
  OrbitCamera orbit;
  orbit.SetDirection(0, 0);
  EXPECT_TRUE(ViewDirectionOf(orbit).isApprox(Eigen::Vector3f::UnitZ(), 1e-6F));
  for (const double azimuth : {-2.0, 0.3, 1.5}) {
    orbit.SetDirection(azimuth, 0.5);
    const Eigen::Matrix3f R = orbit.At(kWidth, kHeight).R_camera_world;
    EXPECT_NEAR(R.determinant(), 1, 1e-5);
    // Sidewards is level, and what is above is above in the picture.
    EXPECT_NEAR(R.row(0).dot(orbit.frame().up.cast<float>()), 0, 1e-6);
    EXPECT_LT(R.row(1).dot(orbit.frame().up.cast<float>()), -0.5);
  }
}

TEST(OrbitCameraTest, APositiveAzimuthLooksToTheRight) {
  OrbitCamera orbit;
  orbit.SetDirection(kRightAngle, 0);
  EXPECT_TRUE(ViewDirectionOf(orbit).isApprox(orbit.frame().right.cast<float>(), 1e-6F));
}

TEST(OrbitCameraTest, FromAboveForwardIsUpwardsInThePicture) {
  OrbitCamera orbit;
  orbit.SetDirection(0, kRightAngle);
  const ViewCamera camera = orbit.At(kWidth, kHeight);
  EXPECT_TRUE(ViewDirectionOf(orbit).isApprox(-orbit.frame().up.cast<float>(), 1e-6F));
  EXPECT_TRUE(camera.R_camera_world.row(1).transpose().isApprox(
      -orbit.frame().forward.cast<float>(), 1e-6F));
}

TEST(OrbitCameraTest, ItDoesNotTurnOverTheTop) {
  OrbitCamera orbit;
  orbit.Turn(0, 10);
  EXPECT_DOUBLE_EQ(orbit.elevation(), kRightAngle);
}

TEST(OrbitCameraTest, PanningMovesWhatIsSeenWithTheMouse) {
  OrbitCamera orbit;
  orbit.SetDirection(0.4, 0.6);
  const Eigen::Vector3f target = orbit.target().cast<float>();
  orbit.Pan(30, -12, kHeight);
  const ViewCamera camera = orbit.At(kWidth, kHeight);
  const Eigen::Vector2f moved = camera.Project(camera.ToCamera(target));
  EXPECT_NEAR((moved - Eigen::Vector2f(349.5F, 227.5F)).norm(), 0, 0.05);
}

TEST(OrbitCameraTest, ZoomingMultipliesTheDistance) {
  OrbitCamera orbit;
  orbit.LookAt({0, 0, 0}, 4);
  orbit.Zoom(0.5);
  EXPECT_DOUBLE_EQ(orbit.distance(), 2);
}

TEST(OrbitCameraTest, AFitShowsAllOfABoxAndFillsThePicture) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 8000; ++i) {
    const auto axis = [i](int step) { return 0.1F * static_cast<float>(i / step % 20); };
    points.emplace_back(5 + axis(1), axis(20), axis(400));
  }
  for (const double elevation : {0.0, 0.6, kRightAngle}) {
    OrbitCamera orbit;
    orbit.SetDirection(0.5, elevation);
    orbit.Fit(points, kWidth, kHeight);
    const ViewCamera camera = orbit.At(kWidth, kHeight);
    int num_inside = 0;
    float highest = 0;
    for (const Eigen::Vector3f& p : points) {
      const Eigen::Vector2f pixel = camera.Project(camera.ToCamera(p));
      const bool inside = pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < kWidth &&
                          pixel.y() < kHeight && camera.ToCamera(p).z() > 0;
      if (inside) ++num_inside;
      highest = std::max(highest, std::abs(pixel.y() - 0.5F * kHeight));
    }
    EXPECT_GT(num_inside, 0.95 * 8000) << elevation;
    EXPECT_GT(highest, 0.3F * kHeight) << elevation;
  }
}

TEST(OrbitCameraTest, AFitToNothingChangesNothing) {
  OrbitCamera orbit;
  orbit.LookAt({1, 2, 3}, 4);
  orbit.Fit({}, kWidth, kHeight);
  EXPECT_EQ(orbit.target(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(orbit.distance(), 4);
}

TEST(ClipFromWorldTest, AgreesWithTheProjectionToPixels) {
  OrbitCamera orbit;
  orbit.SetDirection(-0.8, 0.3);
  orbit.LookAt({0.2, 0.1, 1}, 3);
  const ViewCamera camera = orbit.At(kWidth, kHeight);
  const Eigen::Matrix4f clip_from_world = ClipFromWorld(camera, 0.1F, 50.0F);
  for (const Eigen::Vector3f& p : {Eigen::Vector3f(0, 0, 1), {0.5F, -0.4F, 1.2F}, {1, 0.6F, 0}}) {
    const Eigen::Vector4f clip = clip_from_world * p.homogeneous();
    const Eigen::Vector2f pixel = camera.Project(camera.ToCamera(p));
    EXPECT_NEAR(0.5F * (clip.x() / clip.w() + 1) * kWidth - 0.5F, pixel.x(), 0.01);
    EXPECT_NEAR(0.5F * (1 - clip.y() / clip.w()) * kHeight - 0.5F, pixel.y(), 0.01);
    EXPECT_NEAR(clip.w(), camera.ToCamera(p).z(), 1e-5);
  }
}

TEST(ClipFromWorldTest, NearAndFarAreTheEndsOfTheDepthRange) {
  const ViewCamera camera = OrbitCamera().At(kWidth, kHeight);
  const Eigen::Matrix4f clip_from_world = ClipFromWorld(camera, 0.5F, 20.0F);
  const Eigen::Vector3f forward = camera.R_camera_world.row(2);
  const auto depth = [&](float distance) {
    const Eigen::Vector4f clip =
        clip_from_world * (camera.p_world + distance * forward).homogeneous();
    return clip.z() / clip.w();
  };
  EXPECT_NEAR(depth(0.5F), -1, 1e-4);
  EXPECT_NEAR(depth(20.0F), 1, 1e-4);
}

TEST(PixelRayTest, MeetsThePointThatIsSeenInThePixel) {
  OrbitCamera orbit;
  orbit.SetDirection(1.1, 0.2);
  const ViewCamera camera = orbit.At(kWidth, kHeight);
  const Eigen::Vector3d p_world(0.3, 0.2, -0.4);
  const Eigen::Vector2f pixel = camera.Project(camera.ToCamera(p_world.cast<float>()));
  const Eigen::Vector3d ray = PixelRay(camera, pixel.cast<double>());
  const Eigen::Vector3d way = p_world - camera.p_world.cast<double>();
  EXPECT_NEAR(ray.norm(), 1, 1e-9);
  EXPECT_NEAR(ray.cross(way).norm(), 0, 1e-3);
}

}  // namespace
}  // namespace semslam

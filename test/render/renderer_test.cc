// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/renderer.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "semslam/render/scenes.h"

namespace semslam {
namespace {

// At the origin, looking along world's +y, level.
Rigid3 LookingAhead(const Eigen::Vector3d& p_world) {
  return {ExpSO3({-std::numbers::pi / 2, 0, 0}), p_world};
}

Object MakeObject(const TriangleMesh& mesh, const Material& material = {}) {
  return {"thing", {{mesh, material}}};
}

Scene WallAndBall() {
  Scene scene;
  scene.Add(MakeObject(MakeBox({20, 0.1F, 20})), {Eigen::Quaterniond::Identity(), {0, 3.05, 0}});
  scene.Add(MakeObject(MakeEllipsoid(Eigen::Vector3f::Constant(0.5F), 512)),
            {Eigen::Quaterniond::Identity(), {0.2, 2, 0.1}});
  scene.AddLight({{1, -1, 4}, {5, 5, 5}, 0.3F});
  return scene;
}

constexpr double kBallRadius = 0.5;
const Eigen::Vector3d kBallCenter(0.2, 2, 0.1);

// Depth along the ray (x/z, y/z, 1) from the origin: analytic intersection with the ball.
std::optional<double> BallDepth(const Eigen::Vector2f& ray) {
  const Eigen::Vector3d direction(ray.x(), 1.0, -ray.y());  // Camera (x, y, z) is world (x, -z, y).
  const double a = direction.squaredNorm();
  const double b = direction.dot(kBallCenter);
  const double c = kBallCenter.squaredNorm() - kBallRadius * kBallRadius;
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return std::nullopt;
  return (b - std::sqrt(discriminant)) / a;
}

TEST(Renderer, DepthOfAWallIsExactDespiteLensDistortion) {
  const PinholeCamera camera(CameraByName("TUM1"));
  const Scene scene = WallAndBall();
  const IdealImage image = Renderer(scene, {}).Render(RayTable(camera), LookingAhead({0, 0, 0}));
  int num_wall = 0;
  for (int y = 0; y < camera.height(); ++y) {
    for (int x = 0; x < camera.width(); ++x) {
      if (image.labels.at<std::uint16_t>(y, x) != 1) continue;
      ASSERT_NEAR(image.depth.at<double>(y, x), 3.0, 1e-6) << x << ' ' << y;
      ++num_wall;
    }
  }
  EXPECT_GT(num_wall, 200000);
}

TEST(Renderer, DepthAndLabelsOfABallAreThoseOfGeometry) {
  const PinholeCamera camera(CameraByName("TUM1"));
  const RayTable rays(camera);
  const Scene scene = WallAndBall();
  const IdealImage image = Renderer(scene, {}).Render(rays, LookingAhead({0, 0, 0}));
  int num_ball = 0;
  int num_wrong = 0;
  for (int y = 0; y < camera.height(); ++y) {
    for (int x = 0; x < camera.width(); ++x) {
      const std::optional<double> expected = BallDepth(rays.At(x, y));
      const bool is_ball = image.labels.at<std::uint16_t>(y, x) == 2;
      num_wrong += is_ball != expected.has_value() ? 1 : 0;  // The mesh's rim is a polygon.
      if (!is_ball || !expected || image.incidence.at<float>(y, x) < 0.2F) continue;
      ASSERT_NEAR(image.depth.at<double>(y, x), *expected, 2e-4) << x << ' ' << y;
      ++num_ball;
    }
  }
  EXPECT_GT(num_ball, 30000);
  EXPECT_LT(num_wrong, 100);
}

TEST(Renderer, IncidenceIsTheCosineToTheNormal) {
  const PinholeCamera camera(CameraByName("TUM3"));
  const RayTable rays(camera);
  const Scene scene = WallAndBall();
  const IdealImage image = Renderer(scene, {}).Render(rays, LookingAhead({0, 0, 0}));
  const Eigen::Vector2f& ray = rays.At(30, 40);
  EXPECT_NEAR(image.incidence.at<float>(40, 30), 1.0 / std::sqrt(1.0 + ray.squaredNorm()), 1e-5);
}

TEST(Renderer, NothingIsZero) {
  const PinholeCamera camera(CameraByName("TUM3"));
  const Scene scene = WallAndBall();
  const Rigid3 away{ExpSO3({std::numbers::pi / 2, 0, 0}), {0, 0, 0}};
  const IdealImage image = Renderer(scene, {}).Render(RayTable(camera), away);
  EXPECT_EQ(cv::countNonZero(image.depth), 0);
  EXPECT_EQ(cv::countNonZero(image.labels), 0);
}

TEST(Renderer, PicturesOfAnyWidthAreThoseOfTheWideOne) {
  PinholeCamera::Parameters parameters = CameraByName("TUM3");
  parameters.width = 96;
  parameters.height = 20;
  parameters.cx = 40;
  parameters.cy = 10;
  const Scene scene = WallAndBall();
  const Renderer::Options plain = {.smooth_edges = false, .shadows = false, .occlusion_reach = 0};
  const Renderer renderer(scene, plain);
  const Rigid3 T_world_camera = LookingAhead({-0.32, 0, 0.1});  // The ball's rim is in the picture.
  const IdealImage wide = renderer.Render(RayTable(PinholeCamera(parameters)), T_world_camera);
  for (const int width : {61, 62, 63, 64}) {
    parameters.width = width;
    const IdealImage image = renderer.Render(RayTable(PinholeCamera(parameters)), T_world_camera);
    const cv::Rect part(0, 0, width, 20);
    EXPECT_EQ(cv::norm(image.depth, wide.depth(part), cv::NORM_INF), 0) << width;
    EXPECT_EQ(cv::norm(image.labels, wide.labels(part), cv::NORM_INF), 0) << width;
    EXPECT_LT(cv::norm(image.radiance, wide.radiance(part), cv::NORM_INF), 1e-4) << width;
  }
  EXPECT_GT(cv::countNonZero(wide.labels == 1), 50);
  EXPECT_GT(cv::countNonZero(wide.labels == 2), 50);
}

TEST(Renderer, WhatABallHidesFromTheLampIsDark) {
  Scene scene;
  scene.Add(MakeObject(MakeRectangle(4, 4)), {});
  scene.Add(MakeObject(MakeEllipsoid(Eigen::Vector3f::Constant(0.3F))),
            {Eigen::Quaterniond::Identity(), {0, 0, 1}});
  scene.AddLight({{0, 0, 3}, {5, 5, 5}, 0});
  scene.SetAmbient(Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero());
  const PinholeCamera camera(CameraByName("TUM3"));
  const Rigid3 from_the_side{ExpSO3({-0.75 * std::numbers::pi, 0, 0}),
                             {0, -1.2, 1.2}};  // 45 degrees down.
  const IdealImage image =
      Renderer(scene, {.occlusion_reach = 0}).Render(RayTable(camera), from_the_side);
  const auto light_at = [&](const Eigen::Vector3d& p_world) {
    const Eigen::Vector2d pixel = camera.Project(from_the_side.Inverse() * p_world);
    return image.radiance.at<cv::Vec3f>(cvRound(pixel.y()), cvRound(pixel.x()))[0];
  };
  // The shadow's radius on the ground is 0.3 / 2 * 3 = 0.45, a little more as the ball is round.
  EXPECT_EQ(light_at({0, 0.0, 0}), 0.0F);
  EXPECT_EQ(light_at({0.38, 0.0, 0}), 0.0F);
  EXPECT_GT(light_at({0.55, 0.0, 0}), 0.3F);
}

// A chessboard of 8 x 6 squares of 5 cm that stands at y = 0.8 and looks at the origin.
Scene Chessboard() {
  cv::Mat board(6, 8, CV_8UC3);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 8; ++x)
      board.at<cv::Vec3b>(y, x) = cv::Vec3b::all((x + y) % 2 == 0 ? 30 : 230);
  }
  cv::Mat large;
  cv::resize(board, large, {}, 100, 100, cv::INTER_NEAREST);
  Material material;
  material.texture = std::make_shared<const Texture>(large);
  material.repeats_per_metre = {1 / 0.4F, 1 / 0.3F};
  Scene scene;
  scene.Add(MakeObject(MakeRectangle(0.4F, 0.3F), material),
            {ExpSO3({std::numbers::pi / 2, 0, 0}), {0, 0.8, 0}});
  scene.SetAmbient(Eigen::Vector3f::Ones(), Eigen::Vector3f::Ones());
  return scene;
}

TEST(Renderer, CornersOfAChessboardAreWhereOpenCvProjectsThem) {
  const PinholeCamera::Parameters p = CameraByName("TUM1");
  const Rigid3 T_world_camera{
      (ExpSO3({0.05, 0.1, -0.08}) * LookingAhead(Eigen::Vector3d::Zero()).rotation).normalized(),
      {0.05, 0.1, -0.04}};
  const Scene scene = Chessboard();
  const IdealImage image =
      Renderer(scene, {.occlusion_reach = 0}).Render(RayTable(PinholeCamera(p)), T_world_camera);

  std::vector<cv::Point3d> corners_world;
  for (int row = 1; row < 6; ++row) {
    for (int column = 1; column < 8; ++column)
      corners_world.emplace_back(0.05 * column - 0.2, 0.8, 0.05 * row - 0.15);
  }
  const Rigid3 T_camera_world = T_world_camera.Inverse();
  const Eigen::Vector3d rotation = LogSO3(T_camera_world.rotation);
  const cv::Vec3d rvec(rotation.x(), rotation.y(), rotation.z());
  const cv::Vec3d tvec(T_camera_world.translation.x(), T_camera_world.translation.y(),
                       T_camera_world.translation.z());
  const cv::Matx33d K(p.fx, 0, p.cx, 0, p.fy, p.cy, 0, 0, 1);
  std::vector<cv::Point2d> expected;
  cv::projectPoints(corners_world, rvec, tvec, K, cv::Vec<double, 5>(p.k1, p.k2, p.p1, p.p2, p.k3),
                    expected);

  cv::Mat gray;
  cv::cvtColor(image.radiance, gray, cv::COLOR_BGR2GRAY);
  cv::GaussianBlur(gray, gray, {}, 1.0);  // The corner finder wants soft edges.
  gray.convertTo(gray, CV_8U, 200);
  std::vector<cv::Point2f> found(expected.begin(), expected.end());
  for (cv::Point2f& corner : found) corner += cv::Point2f(0.8F, -0.7F);
  cv::cornerSubPix(gray, found, {6, 6}, {-1, -1},
                   {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 100, 1e-4});
  cv::Point2d mean(0, 0);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const cv::Point2d error = cv::Point2d(found[i]) - expected[i];
    mean += error * (1.0 / static_cast<double>(found.size()));
    EXPECT_LT(cv::norm(error), 0.05) << "corner " << i;
  }
  EXPECT_LT(cv::norm(mean), 0.02);
}

}  // namespace
}  // namespace semslam

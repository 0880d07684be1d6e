// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/dense/keyframe_cloud.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "semslam/base/random.h"

#include "dense/octahedral.h"
#include "dense/synthetic_depth.h"

namespace semslam {
namespace {

using testing::RenderBoxes;
using testing::TestCamera;

TEST(OctahedralNormal, LosesLessThanADegree) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3f normal =
        Eigen::Vector3d(random.Gaussian(), random.Gaussian(), random.Gaussian())
            .normalized()
            .cast<float>();
    const Eigen::Vector3f decoded = DecodeNormal(EncodeNormal(normal));
    EXPECT_LT((decoded - normal).norm(), 0.0175) << normal.transpose();
  }
}

TEST(KeyframeCloud, HoldsThePointsOfTheSurfaceInTheCameraFrame) {
  PinholeCamera::Parameters parameters = TestCamera().parameters();
  parameters.k1 = 0.2;  // The true rays are bent.
  parameters.k2 = -0.3;
  const PinholeCamera camera(parameters);
  const auto rays = std::make_shared<const RayTable>(camera);
  const RgbdImage image = RenderBoxes({{{-5, -5, 1.5}, {5, 5, 1.6}, 77}}, camera, Rigid3());
  const auto cloud = BuildKeyframeCloud(KeyframeId{7}, image, rays, {});

  EXPECT_EQ(cloud->id(), KeyframeId{7});
  EXPECT_EQ(cloud->num_points(), 160U * 120U);
  std::size_t num_visited = 0;
  cloud->ForEach([&](const KeyframePoint& point) {
    ++num_visited;
    EXPECT_NEAR(point.p_camera.z(), 1.5F, 1e-4F);
    const Eigen::Vector2d pixel = camera.Distort(camera.Project(point.p_camera.cast<double>()));
    EXPECT_NEAR(pixel.x(), point.column, 0.01);
    EXPECT_NEAR(pixel.y(), point.row, 0.01);
    EXPECT_LT((point.n_camera - Eigen::Vector3f(0, 0, -1)).norm(), 0.03);
    EXPECT_EQ(point.color, (Rgb{200, 90, 77}));
  });
  EXPECT_EQ(num_visited, cloud->num_points());
}

TEST(KeyframeCloud, TellsTheCellOfEveryPoint) {
  const RgbdImage image =
      RenderBoxes({{{-0.2, -0.3, 1.5}, {0.4, 0.1, 1.6}, 77}}, TestCamera(), Rigid3());
  const auto cloud =
      BuildKeyframeCloud(KeyframeId{0}, image, std::make_shared<const RayTable>(TestCamera()), {});
  std::size_t num_visited = 0;
  cloud->ForEachCell([&](std::size_t cell, const KeyframePoint& point) {
    ++num_visited;
    const auto columns = static_cast<std::size_t>(cloud->grid_columns());
    EXPECT_EQ(static_cast<int>(cell % columns) * cloud->stride(), point.column);
    EXPECT_EQ(static_cast<int>(cell / columns) * cloud->stride(), point.row);
  });
  EXPECT_GT(num_visited, 0U);
  EXPECT_EQ(num_visited, cloud->num_points());
  EXPECT_LT(num_visited, cloud->num_cells());
}

TEST(KeyframeCloud, FitsInAMegabyteAtFullSize) {
  PinholeCamera::Parameters parameters;
  parameters.fx = parameters.fy = 525;
  parameters.cx = 319.5;
  parameters.cy = 239.5;
  const PinholeCamera camera(parameters);
  RgbdImage image;
  image.color = cv::Mat::zeros(480, 640, CV_8UC3);
  image.depth = cv::Mat(480, 640, CV_32FC1, cv::Scalar(1.0));
  const auto cloud =
      BuildKeyframeCloud(KeyframeId{0}, image, std::make_shared<const RayTable>(camera), {});
  EXPECT_EQ(cloud->num_points(), 320U * 240U);
  EXPECT_LE(cloud->memory_bytes(), 1'000'000U);
}

TEST(KeyframeCloud, OfAnImageWithoutDepthIsEmpty) {
  RgbdImage image = RenderBoxes({}, TestCamera(), Rigid3());
  const auto cloud =
      BuildKeyframeCloud(KeyframeId{0}, image, std::make_shared<const RayTable>(TestCamera()), {});
  EXPECT_EQ(cloud->num_points(), 0U);
  EXPECT_EQ(cloud->max_range(), 0.0F);
  EXPECT_FALSE(cloud->At(10, 10).has_value());
}

TEST(KeyframeCloud, RefusesAnImageOfAnotherSize) {
  const auto rays = std::make_shared<const RayTable>(TestCamera());
  RgbdImage image;
  image.color = cv::Mat::zeros(480, 640, CV_8UC3);
  image.depth = cv::Mat::zeros(480, 640, CV_32FC1);
  EXPECT_THROW(BuildKeyframeCloud(KeyframeId{0}, image, rays, {}), std::logic_error);
}

}  // namespace
}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/dense/depth_filter.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "semslam/base/error.h"

#include "dense/synthetic_depth.h"

namespace semslam {
namespace {

using testing::Box;
using testing::RenderBoxes;
using testing::TestCamera;

constexpr double kKinectStep = 0.0029;

Box WallAt(double z) { return {{-20, -20, z}, {20, 20, z + 0.1}}; }

double AngleBetween(const Eigen::Vector3f& a, const Eigen::Vector3d& b) {
  return std::acos(std::clamp(a.cast<double>().dot(b), -1.0, 1.0));
}

TEST(FilterDepth, KeepsOnlyTheRange) {
  const RayTable rays(TestCamera());
  for (const auto& [z, kept] : {std::pair{0.25, false}, {0.5, true}, {3.9, true}, {4.5, false}}) {
    const RgbdImage image = RenderBoxes({WallAt(z)}, TestCamera(), Rigid3());
    const cv::Mat filtered = FilterDepth(image.depth, rays, {});
    EXPECT_EQ(cv::countNonZero(filtered) > 0, kept) << z;
  }
}

TEST(FilterDepth, DropsNanAndNegativeDepth) {
  const RayTable rays(TestCamera());
  RgbdImage image = RenderBoxes({WallAt(1)}, TestCamera(), Rigid3());
  image.depth.at<float>(100, 100) = std::nanf("");
  image.depth.at<float>(50, 50) = -1.0F;
  const cv::Mat filtered = FilterDepth(image.depth, rays, {});
  EXPECT_EQ(filtered.at<float>(100, 100), 0.0F);
  EXPECT_EQ(filtered.at<float>(50, 50), 0.0F);
  EXPECT_EQ(filtered.at<float>(100, 110), image.depth.at<float>(100, 110));
}

TEST(FilterDepth, DropsPixelsThatFlyBetweenAnObjectAndTheWallBehindIt) {
  const RayTable rays(TestCamera());
  RgbdImage image =
      RenderBoxes({WallAt(2), {{-0.2, -0.2, 1}, {0.2, 0.2, 1.2}}}, TestCamera(), Rigid3());
  // A camera averages over the edge: blur the depth by one pixel.
  cv::Mat blurred = image.depth.clone();
  for (int row = 0; row < blurred.rows; ++row) {
    for (int column = 1; column + 1 < blurred.cols; ++column) {
      blurred.at<float>(row, column) =
          (image.depth.at<float>(row, column - 1) + image.depth.at<float>(row, column) +
           image.depth.at<float>(row, column + 1)) /
          3;
    }
  }
  const cv::Mat filtered = FilterDepth(blurred, rays, {});
  int num_flying = 0;
  for (auto it = filtered.begin<float>(); it != filtered.end<float>(); ++it) {
    if (*it > 1.01F && *it < 1.99F) ++num_flying;
  }
  EXPECT_EQ(num_flying, 0);
  EXPECT_GT(cv::countNonZero(filtered), 300 * 200);
}

TEST(FilterDepth, KeepsASteepWallWithQuantisedDepth) {
  const RayTable rays(TestCamera());
  // Seen at 60 degrees against its normal.
  const Rigid3 T_world_camera{ExpSO3({0, 1.047, 0}), {0, 0, 0}};
  RgbdImage image = RenderBoxes({WallAt(0.6)}, TestCamera(), T_world_camera);
  testing::QuantiseDepth(image.depth, kKinectStep);
  const int column = 120;
  const cv::Mat filtered = FilterDepth(image.depth, rays, {});
  for (int row = 20; row < 220; ++row) EXPECT_GT(filtered.at<float>(row, column), 0) << row;
}

TEST(EstimateNormals, AreExactOnAnExactPlane) {
  const RayTable rays(TestCamera());
  for (const double tilt : {0.0, 0.4, 0.9}) {
    const Rigid3 T_world_camera{ExpSO3({0.3 * tilt, tilt, 0}), {0, 0, 0}};
    const Eigen::Vector3d expected = T_world_camera.rotation.inverse() * Eigen::Vector3d(0, 0, -1);
    const RgbdImage image = RenderBoxes({WallAt(1)}, TestCamera(), T_world_camera);
    const auto normals = EstimateNormals(image.depth, rays, 4, {});
    ASSERT_EQ(normals.size(), 80U * 60U);
    int num_checked = 0;
    for (const Eigen::Vector3f& normal : normals) {
      if (normal.isZero()) continue;
      EXPECT_LT(AngleBetween(normal, expected), 0.003);
      ++num_checked;
    }
    EXPECT_GT(num_checked, 3000);
  }
}

TEST(EstimateNormals, SurviveTheDepthStepsOfAKinect) {
  const RayTable rays(TestCamera());
  const Rigid3 T_world_camera{ExpSO3({0.2, 0.5, 0}), {0, 0, 0}};
  const Eigen::Vector3d expected = T_world_camera.rotation.inverse() * Eigen::Vector3d(0, 0, -1);
  RgbdImage image = RenderBoxes({WallAt(1.5)}, TestCamera(), T_world_camera);
  testing::QuantiseDepth(image.depth, kKinectStep);
  std::vector<double> errors;
  for (const Eigen::Vector3f& normal : EstimateNormals(image.depth, rays, 4, {})) {
    if (!normal.isZero()) errors.push_back(AngleBetween(normal, expected));
  }
  ASSERT_GT(errors.size(), 4000U);
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.05);  // 3 degrees.
  EXPECT_LT(errors[errors.size() * 95 / 100], 0.12);
}

TEST(EstimateNormals, OfABoxAreNotBentByTheWallBehindIt) {
  const RayTable rays(TestCamera());
  const RgbdImage image =
      RenderBoxes({WallAt(1.3), {{-0.2, -0.2, 1}, {0.2, 0.2, 1.3}}}, TestCamera(), Rigid3());
  const cv::Mat filtered = FilterDepth(image.depth, rays, {});
  for (const Eigen::Vector3f& normal : EstimateNormals(filtered, rays, 2, {})) {
    if (normal.isZero()) continue;
    EXPECT_LT(AngleBetween(normal, {0, 0, -1}), 0.01);
  }
}

TEST(EstimateNormals, AreMissingAtGrazingAngles) {
  const RayTable rays(TestCamera());
  const Box floor{{-20, 0.1, -20}, {20, 0.2, 20}};  // 10 cm below the camera.
  const RgbdImage image = RenderBoxes({floor}, TestCamera(), Rigid3());
  const auto normals = EstimateNormals(image.depth, rays, 1, {});
  const auto at = [&](int row) { return normals[static_cast<std::size_t>(row * 320 + 160)]; };
  EXPECT_FALSE(at(230).isZero());  // 67 degrees.
  EXPECT_TRUE(at(145).isZero());   // 84 degrees.
}

TEST(DepthFilterOptions, RefuseAnEmptyRange) {
  DepthFilterOptions options;
  options.max_depth = options.min_depth;
  EXPECT_THROW(options.Validate(), InputError);
}

}  // namespace
}  // namespace semslam

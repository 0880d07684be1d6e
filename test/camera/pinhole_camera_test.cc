// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/camera/pinhole_camera.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

namespace semslam {
namespace {

PinholeCamera::Parameters Tum1() {
  return {.fx = 517.306408,
          .fy = 516.469215,
          .cx = 318.643040,
          .cy = 255.313989,
          .k1 = 0.262383,
          .k2 = -0.953104,
          .p1 = -0.005358,
          .p2 = 0.002628,
          .k3 = 1.163314};
}

PinholeCamera::Parameters Tum2() {
  return {.fx = 520.908620,
          .fy = 521.007327,
          .cx = 325.141442,
          .cy = 249.701764,
          .k1 = 0.231222,
          .k2 = -0.784899,
          .p1 = -0.003257,
          .p2 = -0.000105,
          .k3 = 0.917205};
}

PinholeCamera::Parameters Tum3() { return {.fx = 535.4, .fy = 539.2, .cx = 320.1, .cy = 247.6}; }

cv::Matx33d OpenCvMatrix(const PinholeCamera& camera) {
  return {camera.fx(), 0, camera.cx(), 0, camera.fy(), camera.cy(), 0, 0, 1};
}

cv::Vec<double, 5> OpenCvDistortion(const PinholeCamera& camera) {
  const PinholeCamera::Parameters& p = camera.parameters();
  return {p.k1, p.k2, p.p1, p.p2, p.k3};
}

std::vector<cv::Point2d> GridOfPixels() {
  std::vector<cv::Point2d> pixels;
  for (int y = 0; y < 480; y += 37) {
    for (int x = 0; x < 640; x += 49) pixels.emplace_back(x, y);
  }
  for (const int y : {0, 479}) {
    for (const int x : {0, 639}) pixels.emplace_back(x, y);
  }
  return pixels;
}

class DistortedCamera : public testing::TestWithParam<PinholeCamera::Parameters> {
 protected:
  const PinholeCamera camera_{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(TumCameras,
                         DistortedCamera,
                         testing::Values(Tum1(), Tum2()),
                         [](const auto& tested) {
                           return "Tum" + std::to_string(tested.index + 1);
                         });

TEST_P(DistortedCamera, UndistortsAsOpenCvDoes) {
  const std::vector<cv::Point2d> pixels = GridOfPixels();
  std::vector<cv::Point2d> expected;
  const cv::Matx33d matrix = OpenCvMatrix(camera_);
  const cv::TermCriteria criteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 200, 1e-12);
  cv::undistortPoints(pixels, expected, matrix, OpenCvDistortion(camera_), cv::noArray(), matrix,
                      criteria);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Eigen::Vector2d ideal = camera_.Undistort({pixels[i].x, pixels[i].y});
    EXPECT_NEAR(ideal.x(), expected[i].x, 1e-6) << pixels[i];
    EXPECT_NEAR(ideal.y(), expected[i].y, 1e-6) << pixels[i];
  }
}

TEST_P(DistortedCamera, DistortsAsOpenCvProjects) {
  std::vector<cv::Point3d> points;
  for (double y = -0.4; y <= 0.4; y += 0.1) {
    for (double x = -0.5; x <= 0.5; x += 0.1) points.emplace_back(2 * x, 2 * y, 2);
  }
  std::vector<cv::Point2d> expected;
  cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), OpenCvMatrix(camera_),
                    OpenCvDistortion(camera_), expected);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d ideal = camera_.Project({points[i].x, points[i].y, points[i].z});
    const Eigen::Vector2d raw = camera_.Distort(ideal);
    EXPECT_NEAR(raw.x(), expected[i].x, 1e-9) << points[i];
    EXPECT_NEAR(raw.y(), expected[i].y, 1e-9) << points[i];
  }
}

TEST_P(DistortedCamera, DistortUndoesUndistortOnTheWholeImage) {
  for (int y = 0; y < camera_.height(); y += 7) {
    for (int x = 0; x < camera_.width(); x += 7) {
      const Eigen::Vector2d raw(x, y);
      EXPECT_LT((camera_.Distort(camera_.Undistort(raw)) - raw).norm(), 1e-9) << raw.transpose();
    }
  }
}

TEST_P(DistortedCamera, IdealBoundsAreTheSmallestThatHoldEveryPixel) {
  PinholeCamera::Bounds expected{1e9, 1e9, -1e9, -1e9};
  for (int y = 0; y < camera_.height(); ++y) {
    for (int x = 0; x < camera_.width(); ++x) {
      const Eigen::Vector2d ideal = camera_.Undistort({x, y});
      expected.min_x = std::min(expected.min_x, ideal.x());
      expected.max_x = std::max(expected.max_x, ideal.x());
      expected.min_y = std::min(expected.min_y, ideal.y());
      expected.max_y = std::max(expected.max_y, ideal.y());
    }
  }
  EXPECT_DOUBLE_EQ(camera_.ideal_bounds().min_x, expected.min_x);
  EXPECT_DOUBLE_EQ(camera_.ideal_bounds().max_x, expected.max_x);
  EXPECT_DOUBLE_EQ(camera_.ideal_bounds().min_y, expected.min_y);
  EXPECT_DOUBLE_EQ(camera_.ideal_bounds().max_y, expected.max_y);
}

TEST_P(DistortedCamera, RayTableLooksWhereTheUndistortedPixelDoes) {
  const RayTable rays(camera_);
  for (int y = 0; y < camera_.height(); y += 31) {
    for (int x = 0; x < camera_.width(); x += 29) {
      const Eigen::Vector3d expected = camera_.Unproject(camera_.Undistort({x, y}), 1.7);
      const Eigen::Vector3d found = rays.Unproject(x, y, 1.7f).cast<double>();
      EXPECT_LT((found - expected).norm(), 1e-6) << x << ' ' << y;
    }
  }
}

TEST(PinholeCamera, ProjectsToThePixelThatUnprojectsToThePoint) {
  const PinholeCamera camera(Tum3());
  const Eigen::Vector3d p_camera(0.3, -0.2, 1.5);
  const Eigen::Vector2d pixel = camera.Project(p_camera);
  EXPECT_NEAR(pixel.x(), 320.1 + 535.4 * 0.2, 1e-9);
  EXPECT_NEAR(pixel.y(), 247.6 - 539.2 * 0.2 / 1.5, 1e-9);
  EXPECT_LT((camera.Unproject(pixel, 1.5) - p_camera).norm(), 1e-12);
}

TEST(PinholeCamera, LeavesPixelsAloneWithoutDistortion) {
  const PinholeCamera camera(Tum3());
  EXPECT_FALSE(camera.has_distortion());
  EXPECT_EQ(camera.Undistort({3, 4}), Eigen::Vector2d(3, 4));
  EXPECT_EQ(camera.Distort({3, 4}), Eigen::Vector2d(3, 4));
  EXPECT_EQ(camera.ideal_bounds().max_x, 639);
  EXPECT_EQ(camera.ideal_bounds().max_y, 479);
}

TEST(PinholeCamera, RefusesImpossibleParameters) {
  const auto refused = [](void (*change)(PinholeCamera::Parameters&)) {
    PinholeCamera::Parameters parameters = Tum1();
    change(parameters);
    try {
      const PinholeCamera camera(parameters);
    } catch (const std::logic_error&) {
      return true;
    }
    return false;
  };
  using Parameters = PinholeCamera::Parameters;
  EXPECT_FALSE(refused([](Parameters&) {}));
  EXPECT_TRUE(refused([](Parameters& p) { p.width = 0; }));
  EXPECT_TRUE(refused([](Parameters& p) { p.height = -480; }));
  EXPECT_TRUE(refused([](Parameters& p) { p.fx = 0; }));
  EXPECT_TRUE(refused([](Parameters& p) { p.fy = -516; }));
  EXPECT_TRUE(refused([](Parameters& p) { p.fx = std::numeric_limits<double>::infinity(); }));
  EXPECT_TRUE(refused([](Parameters& p) { p.cx = std::numeric_limits<double>::quiet_NaN(); }));
  EXPECT_TRUE(refused([](Parameters& p) { p.k3 = std::numeric_limits<double>::quiet_NaN(); }));
}

}  // namespace
}  // namespace semslam

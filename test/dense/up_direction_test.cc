// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/dense/up_direction.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace semslam {
namespace {

const Eigen::Vector3f kCameraUp(0, -1, 0);

std::vector<Eigen::Vector3f> Repeat(std::size_t count, const Eigen::Vector3f& normal) {
  return std::vector<Eigen::Vector3f>(count, normal);
}

TEST(CommonUpNormal, IsThatOfTheLargestLevelSurface) {
  const Eigen::Vector3f desk = Eigen::Vector3f(0.1F, -0.8F, -0.5F).normalized();
  std::vector<Eigen::Vector3f> normals(500, desk);
  normals.insert(normals.end(), 2000, Eigen::Vector3f(0, 0, -1));  // A wall: 90 degrees off.
  normals.insert(normals.end(), 200, Eigen::Vector3f(0, -1, 0));   // A smaller surface.
  normals.insert(normals.end(), 100, Eigen::Vector3f::Constant(NAN));
  const std::optional<Eigen::Vector3f> up = CommonUpNormal(normals, kCameraUp);
  ASSERT_TRUE(up);
  EXPECT_LT((*up - desk).norm(), 1e-3F);
}

TEST(CommonUpNormal, IsNotTheWallsForACameraThatLooksDown) {
  const float pitch = 40.0F * 3.14159265F / 180.0F;
  const Eigen::Vector3f desk(0, -std::cos(pitch), -std::sin(pitch));
  std::vector<Eigen::Vector3f> normals = Repeat(1000, desk);
  const Eigen::Vector3f wall(0, -std::sin(pitch),
                             std::cos(pitch));  // 50 degrees from the camera's.
  normals.insert(normals.end(), 1800, wall);
  const std::optional<Eigen::Vector3f> up = CommonUpNormal(normals, kCameraUp);
  ASSERT_TRUE(up);
  EXPECT_LT((*up - desk).norm(), 1e-3F);
}

TEST(CommonUpNormal, IsNotKnownWithoutLevelSurfaces) {
  EXPECT_FALSE(CommonUpNormal({}, kCameraUp));
  EXPECT_FALSE(CommonUpNormal(Repeat(1000, {0, 0, -1}), kCameraUp));
}

}  // namespace
}  // namespace semslam

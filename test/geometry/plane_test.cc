// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/geometry/plane.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "semslam/base/random.h"

namespace semslam {
namespace {

PointMoments MomentsOfPlane(const Plane& plane, const Eigen::Vector3d& centre, double noise) {
  Random random(3);
  PointMoments moments;
  const Eigen::Vector3d u = plane.normal.unitOrthogonal();
  const Eigen::Vector3d v = plane.normal.cross(u);
  const Eigen::Vector3d foot = centre - plane.SignedDistance(centre) * plane.normal;
  for (int i = 0; i < 2000; ++i) {
    moments.Add(foot + random.Uniform(-0.5, 0.5) * u + random.Uniform(-0.2, 0.2) * v +
                noise * random.Gaussian() * plane.normal);
  }
  return moments;
}

const Plane kSlanted{Eigen::Vector3d(1, 2, -3).normalized(), 0.7};

TEST(Plane, FitFindsThePlaneOfExactPoints) {
  const auto fit = FitPlane(MomentsOfPlane(kSlanted, {4, -2, 1}, 0));
  ASSERT_TRUE(fit);
  const double sign = fit->plane.normal.dot(kSlanted.normal) < 0 ? -1 : 1;
  EXPECT_NEAR((sign * fit->plane.normal - kSlanted.normal).norm(), 0, 1e-6);
  EXPECT_NEAR(sign * fit->plane.offset, kSlanted.offset, 1e-6);
  EXPECT_NEAR(fit->variation, 0, 1e-9);
}

TEST(Plane, FitReportsNoiseAndWidth) {
  const auto fit = FitPlane(MomentsOfPlane(kSlanted, {0, 0, 0}, 0.005));
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->rms, 0.005, 0.0005);
  EXPECT_NEAR(fit->width, 0.4 / std::sqrt(12.0), 0.005);
}

TEST(Plane, MomentsOfTwoSetsAddUp) {
  PointMoments left;
  PointMoments right;
  PointMoments all;
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d p(random.Uniform(), random.Uniform(), random.Uniform());
    (i % 2 == 0 ? left : right).Add(p, 0.5 + i);
    all.Add(p, 0.5 + i);
  }
  left += right;
  EXPECT_NEAR((left.Covariance() - all.Covariance()).norm(), 0, 1e-12);
  EXPECT_NEAR((left.Mean() - all.Mean()).norm(), 0, 1e-12);
}

TEST(Plane, FitOfALineIsNothing) {
  PointMoments moments;
  for (int i = 0; i < 50; ++i)
    moments.Add(Eigen::Vector3d(1, 2, 3) + i * Eigen::Vector3d(1, -1, 2));
  EXPECT_FALSE(FitPlane(moments));
}

TEST(Plane, FitOfOnePlaceOrOfNothingIsNothing) {
  PointMoments moments;
  EXPECT_FALSE(FitPlane(moments));
  for (int i = 0; i < 50; ++i) moments.Add({0.1, 0.2, 0.3});
  EXPECT_FALSE(FitPlane(moments));
}

}  // namespace
}  // namespace semslam

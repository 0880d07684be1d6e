// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/geometry/rigid3.h"

#include <numbers>

#include <gtest/gtest.h>

#include "semslam/base/random.h"

namespace semslam {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-12;  // Of a few operations on numbers of about 1.

Eigen::Vector3d RandomVector(Random& random) {
  return {random.Gaussian(), random.Gaussian(), random.Gaussian()};
}

Rigid3 RandomPose(Random& random) { return {ExpSO3(RandomVector(random)), RandomVector(random)}; }

// The exponential series of a rotation's generator: an independent reference.
Eigen::Matrix3d MatrixExponential(const Eigen::Vector3d& rotation_vector) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d term = sum;
  for (int i = 1; i < 40; ++i) {
    term = term * Skew(rotation_vector) / i;
    sum += term;
  }
  return sum;
}

TEST(Rigid3, TakesAPointFromTheInnerToTheOuterFrame) {
  // Frame b stands at (1, 2, 3) of frame a, turned by a quarter about z.
  const Rigid3 T_a_b{ExpSO3({0, 0, kPi / 2}), {1, 2, 3}};
  EXPECT_TRUE((T_a_b * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(1, 3, 3), kRounding));
}

TEST(Rigid3, InverseTakesPointsBack) {
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    const Rigid3 T_a_b = RandomPose(random);
    const Eigen::Vector3d p_b = RandomVector(random);
    EXPECT_LT((T_a_b.Inverse() * (T_a_b * p_b) - p_b).norm(), kRounding);
  }
}

TEST(Rigid3, ChainsLikeItsMatrices) {
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    const Rigid3 T_a_b = RandomPose(random);
    const Rigid3 T_b_c = RandomPose(random);
    const Eigen::Matrix4d expected = T_a_b.ToMatrix() * T_b_c.ToMatrix();
    EXPECT_LT(((T_a_b * T_b_c).ToMatrix() - expected).norm(), kRounding);
  }
}

TEST(Rigid3, StaysARotationOverALongChain) {
  Random random(3);
  Rigid3 pose;
  const Rigid3 step = RandomPose(random);
  for (int i = 0; i < 100'000; ++i) pose = pose * step;
  EXPECT_NEAR(pose.rotation.norm(), 1.0, kRounding);
}

TEST(Rigid3, SurvivesItsMatrix) {
  Random random(4);
  const Rigid3 T_a_b = RandomPose(random);
  const Rigid3 copy = Rigid3::FromMatrix(T_a_b.ToMatrix());
  EXPECT_LT(LocalDifference(T_a_b, copy).norm(), kRounding);
}

TEST(Skew, IsTheCrossProduct) {
  const Eigen::Vector3d a(1, 2, 3);
  const Eigen::Vector3d b(-4, 5, 0.5);
  EXPECT_LT((Skew(a) * b - a.cross(b)).norm(), kRounding);
}

TEST(ExpSO3, IsTheMatrixExponentialAtEveryAngle) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 0.5).normalized();
  for (const double angle : {0.0, 1e-12, 1e-6, 1.9e-4, 2.1e-4, 0.1, 1.0, kPi, 4.0}) {
    const Eigen::Matrix3d expected = MatrixExponential(angle * axis);
    EXPECT_LT((ExpSO3(angle * axis).toRotationMatrix() - expected).norm(), 1e-13) << angle;
  }
}

TEST(LogSO3, UndoesExpFromZeroToPi) {
  const Eigen::Vector3d axis = Eigen::Vector3d(0.3, 1, -0.7).normalized();
  for (const double angle : {0.0, 1e-15, 1e-11, 1e-9, 1e-5, 0.5, 3.0, kPi - 1e-7, kPi - 1e-12}) {
    const Eigen::Vector3d log = LogSO3(ExpSO3(angle * axis));
    EXPECT_LT((log - angle * axis).norm(), 1e-14 + 1e-13 * angle) << angle;
  }
}

TEST(LogSO3, GivesTheShortWayBeyondPi) {
  const Eigen::Vector3d log = LogSO3(ExpSO3({0, 0, kPi + 0.5}));
  EXPECT_LT((log - Eigen::Vector3d(0, 0, 0.5 - kPi)).norm(), kRounding);
}

TEST(LogSO3, TakesBothQuaternionsOfARotationForTheSame) {
  const Eigen::Quaterniond q = ExpSO3({0.1, 0.2, 0.3});
  const Eigen::Quaterniond minus_q(-q.coeffs());
  EXPECT_LT((LogSO3(q) - LogSO3(minus_q)).norm(), kRounding);
}

TEST(Retract, IsUndoneByLocalDifference) {
  Random random(5);
  for (int i = 0; i < 20; ++i) {
    const Rigid3 T_a_b = RandomPose(random);
    Vector6d delta;
    delta << 0.5 * RandomVector(random), RandomVector(random);
    EXPECT_LT((LocalDifference(T_a_b, Retract(T_a_b, delta)) - delta).norm(), 1e-11);
  }
}

// d(Retract(T, delta) * p) / d delta = [-R Skew(p), R] at delta = 0: what every analytic Jacobian
// of this project builds on.
TEST(Retract, MovesPointsAsItsDerivativeSays) {
  Random random(6);
  const Rigid3 T_a_b = RandomPose(random);
  const Eigen::Vector3d p_b = RandomVector(random);
  const Eigen::Matrix3d rotation = T_a_b.rotation.toRotationMatrix();
  Eigen::Matrix<double, 3, 6> expected;
  expected << -rotation * Skew(p_b), rotation;

  constexpr double kStep = 1e-6;
  for (int i = 0; i < 6; ++i) {
    const Vector6d delta = kStep * Vector6d::Unit(i);
    const Eigen::Vector3d numeric =
        (Retract(T_a_b, delta) * p_b - Retract(T_a_b, -delta) * p_b) / (2 * kStep);
    EXPECT_LT((numeric - expected.col(i)).norm(), 1e-8) << "parameter " << i;
  }
}

TEST(RotationAngle, IsTheAngleBetweenTwoPoses) {
  Random random(7);
  const Rigid3 a = RandomPose(random);
  const Rigid3 b = a * Rigid3{ExpSO3({0, 1.25, 0}), {4, 5, 6}};
  EXPECT_NEAR(RotationAngle(a, b), 1.25, kRounding);
  EXPECT_NEAR(RotationAngle(b, a), 1.25, kRounding);
}

TEST(Interpolate, ReachesBothEndsAndTheMiddle) {
  const Rigid3 a{ExpSO3({0, 0, 0.2}), {0, 0, 0}};
  const Rigid3 b{ExpSO3({0, 0, 1.0}), {2, 4, 6}};
  EXPECT_LT(LocalDifference(Interpolate(a, b, 0), a).norm(), kRounding);
  EXPECT_LT(LocalDifference(Interpolate(a, b, 1), b).norm(), kRounding);
  const Rigid3 middle{ExpSO3({0, 0, 0.6}), {1, 2, 3}};
  EXPECT_LT(LocalDifference(Interpolate(a, b, 0.5), middle).norm(), kRounding);
}

}  // namespace
}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "optim/reprojection.h"

#include <functional>

#include <gtest/gtest.h>

#include "optim/huber.h"
#include "optim/pose_normal_equations.h"
#include "optim/synthetic_bundle.h"

namespace semslam::internal {
namespace {

using testing::TestCamera;

constexpr double kStep = 1e-6;       // Of the central differences: error about step^2 and eps/step.
constexpr double kTolerance = 1e-5;  // Relative to derivatives of several hundred pixels a unit.

Eigen::MatrixXd CentralDifferences(
    int size, const std::function<Eigen::Vector3d(const Eigen::VectorXd&)>& residual) {
  Eigen::MatrixXd jacobian(3, size);
  for (int i = 0; i < size; ++i) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(size, i);
    jacobian.col(i) = (residual(step) - residual(-step)) / (2 * kStep);
  }
  return jacobian;
}

struct Case {
  Rigid3 T_world_camera;
  Eigen::Vector3d p_world;
  ImagePoint image;

  Eigen::Vector3d p_camera() const { return T_world_camera.Inverse() * p_world; }
};

Case MakeCase(bool with_depth, std::uint64_t seed) {
  Random random(seed);
  Case result;
  result.T_world_camera = Retract(Rigid3{}, testing::RandomTwist(1.5, 2.0, &random));
  const Eigen::Vector3d p_camera(random.Uniform(-1, 1), random.Uniform(-1, 1),
                                 random.Uniform(0.5, 4));
  result.p_world = result.T_world_camera * p_camera;
  result.image = testing::Observe(TestCamera(), p_camera, with_depth);
  result.image.pixel += Eigen::Vector2d(3, -2);
  result.image.inverse_variance = random.Uniform(0.1, 1);
  return result;
}

class ReprojectionTest : public ::testing::TestWithParam<bool> {};

TEST_P(ReprojectionTest, DerivativeByThePoseIsThatOfRetract) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Case c = MakeCase(GetParam(), seed);
    const Eigen::MatrixXd numeric = CentralDifferences(6, [&](const Vector6d& delta) {
      const Rigid3 moved = Retract(c.T_world_camera, delta);
      return ReprojectionResidual(TestCamera(), moved.Inverse() * c.p_world, c.image);
    });
    const Matrix36d analytic = PoseJacobian(TestCamera(), c.p_camera(), GetParam());
    EXPECT_LT((analytic - numeric).norm(), kTolerance * numeric.norm()) << "seed " << seed;
  }
}

TEST_P(ReprojectionTest, DerivativeByThePointInTheWorldIsPTimesTheRotation) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Case c = MakeCase(GetParam(), seed);
    const Eigen::MatrixXd numeric = CentralDifferences(3, [&](const Eigen::Vector3d& delta) {
      const Eigen::Vector3d p_camera = c.T_world_camera.Inverse() * (c.p_world + delta);
      return ReprojectionResidual(TestCamera(), p_camera, c.image);
    });
    const Eigen::Matrix3d analytic = ProjectionJacobian(TestCamera(), c.p_camera(), GetParam()) *
                                     c.T_world_camera.rotation.toRotationMatrix().transpose();
    EXPECT_LT((analytic - numeric).norm(), kTolerance * numeric.norm()) << "seed " << seed;
  }
}

TEST_P(ReprojectionTest, TermsAreMadeOfResidualAndJacobian) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Case c = MakeCase(GetParam(), seed);
    const double weight = c.image.inverse_variance;
    const Eigen::Vector3d residual = ReprojectionResidual(TestCamera(), c.p_camera(), c.image);
    const Eigen::Matrix3d jacobian = ProjectionJacobian(TestCamera(), c.p_camera(), GetParam());

    const ReprojectionTerm term = LinearizeReprojection(TestCamera(), c.p_camera(), c.image);

    EXPECT_NEAR(term.chi2, weight * residual.squaredNorm(), 1e-9 * term.chi2);
    EXPECT_TRUE(term.Information().isApprox(weight * jacobian.transpose() * jacobian, 1e-12));
    EXPECT_TRUE(term.gradient().isApprox(weight * jacobian.transpose() * residual, 1e-12));
  }
}

TEST_P(ReprojectionTest, PoseNormalEquationsSumJacobiansProducts) {
  PoseNormalEquations equations;
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Case c = MakeCase(GetParam(), seed);
    const Matrix36d jacobian = PoseJacobian(TestCamera(), c.p_camera(), GetParam());
    hessian += c.image.inverse_variance * jacobian.transpose() * jacobian;
    gradient += c.image.inverse_variance * jacobian.transpose() *
                ReprojectionResidual(TestCamera(), c.p_camera(), c.image);
    equations.Add(LinearizeReprojection(TestCamera(), c.p_camera(), c.image));
  }
  EXPECT_TRUE(equations.Hessian().isApprox(hessian, 1e-12));
  EXPECT_TRUE(equations.Gradient().isApprox(gradient, 1e-12));
}

INSTANTIATE_TEST_SUITE_P(WithoutAndWithDepth, ReprojectionTest, ::testing::Bool());

TEST(Reprojection, ResidualWithoutDepthHasNoThirdPart) {
  const Case c = MakeCase(false, 1);
  EXPECT_EQ(ReprojectionResidual(TestCamera(), c.p_camera(), c.image).z(), 0.0);
}

TEST(Huber, WeightIsTheDerivativeOfTheCost) {
  constexpr double kLimit = 7.815;
  for (const double s : {0.5, 7.0, 8.0, 50.0, 1e4}) {
    const double step = 1e-5 * s;
    const double numeric =
        (Huber(s + step, kLimit).cost - Huber(s - step, kLimit).cost) / (2 * step);
    EXPECT_NEAR(Huber(s, kLimit).weight, numeric, 1e-7) << "squared error " << s;
  }
}

}  // namespace
}  // namespace semslam::internal

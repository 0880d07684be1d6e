// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "optim/ceres_reference.h"

#include <ceres/ceres.h>

namespace semslam::testing {
namespace {

struct ReprojectionError {
  StereoCamera camera;
  ImagePoint image;

  template <typename T>
  bool operator()(const T* rotation, const T* translation, const T* point, T* residual) const {
    const Eigen::Map<const Eigen::Quaternion<T>> q(rotation);
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> t(translation);
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> p_world(point);
    const Eigen::Matrix<T, 3, 1> p = q.conjugate() * (p_world - t);
    const T scale = T(std::sqrt(image.inverse_variance));
    const T u = camera.fx * p.x() / p.z() + camera.cx;
    const T v = camera.fy * p.y() / p.z() + camera.cy;
    residual[0] = scale * (u - image.pixel.x());
    residual[1] = scale * (v - image.pixel.y());
    if (image.has_right()) residual[2] = scale * (u - camera.bf / p.z() - image.right_x);
    return true;
  }
};

ceres::CostFunction* MakeCost(const StereoCamera& camera, const ImagePoint& image) {
  auto* error = new ReprojectionError{camera, image};  // Owned by the cost function.
  if (image.has_right()) {
    return new ceres::AutoDiffCostFunction<ReprojectionError, 3, 4, 3, 3>(error);
  }
  return new ceres::AutoDiffCostFunction<ReprojectionError, 2, 4, 3, 3>(error);
}

}  // namespace

CeresSolution SolveWithCeres(const BundleProblem& problem,
                             const Chi2Limits& limits,
                             const CeresVariant& variant) {
  CeresSolution solution{.T_world_camera = problem.T_world_camera, .p_world = problem.p_world};
  ceres::EigenQuaternionManifold manifold;
  ceres::Problem::Options problem_options;
  problem_options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem ceres_problem(problem_options);
  for (const auto& [pose, point, image] : problem.observations) {
    Rigid3& T_world_camera = solution.T_world_camera[pose];
    double* rotation = T_world_camera.rotation.coeffs().data();
    double* translation = T_world_camera.translation.data();
    ceres_problem.AddResidualBlock(
        MakeCost(problem.camera, image),
        variant.robust ? new ceres::HuberLoss(std::sqrt(limits.Of(image))) : nullptr, rotation,
        translation, solution.p_world[point].data());
    ceres_problem.SetManifold(rotation, &manifold);
    if (variant.fix_points) {
      ceres_problem.SetParameterBlockConstant(solution.p_world[point].data());
    }
    if (!problem.pose_is_fixed[pose]) continue;
    ceres_problem.SetParameterBlockConstant(rotation);
    ceres_problem.SetParameterBlockConstant(translation);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = variant.fix_points ? ceres::DENSE_QR : ceres::DENSE_SCHUR;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-16;
  options.parameter_tolerance = 1e-14;
  options.gradient_tolerance = 1e-14;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres_problem, &summary);
  solution.cost = 2.0 * summary.final_cost;
  return solution;
}

}  // namespace semslam::testing

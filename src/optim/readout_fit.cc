// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/optim/readout_fit.h"

#include <Eigen/Cholesky>

#include "optim/reprojection.h"

namespace semslam {
namespace {

// Normal equations of the pose (first six) and the readout time (last).
struct Equations {
  Eigen::Matrix<double, 7, 7> hessian = Eigen::Matrix<double, 7, 7>::Zero();
  Eigen::Matrix<double, 7, 1> gradient = Eigen::Matrix<double, 7, 1>::Zero();
};

void Add(const StereoCamera& camera,
         const Eigen::Vector3d& p_camera,
         const ReadoutObservation& observation,
         Equations* equations) {
  const ImagePoint& image = observation.point.image;
  Eigen::Matrix<double, 3, 7> jacobian;
  jacobian << internal::PoseJacobian(camera, p_camera, image.has_right()), -observation.rate;
  if (!image.has_right()) jacobian(2, 6) = 0;
  const Eigen::Vector3d residual = internal::ReprojectionResidual(camera, p_camera, image);
  equations->hessian += image.inverse_variance * jacobian.transpose() * jacobian;
  equations->gradient += image.inverse_variance * jacobian.transpose() * residual;
}

}  // namespace

ReadoutFit FitReadout(const StereoCamera& camera,
                      const Rigid3& T_world_camera,
                      std::span<const ReadoutObservation> observations,
                      const Chi2Limits& limits) {
  const Rigid3 T_camera_world = T_world_camera.Inverse();
  Equations equations;
  for (const ReadoutObservation& observation : observations) {
    const Eigen::Vector3d p_camera = T_camera_world * observation.point.p_world;
    const double chi2 = internal::ReprojectionChi2(camera, p_camera, observation.point.image);
    if (!(chi2 <= limits.Of(observation.point.image))) continue;
    Add(camera, p_camera, observation, &equations);
  }
  const internal::Matrix6d poses = equations.hessian.topLeftCorner<6, 6>();
  const Eigen::LDLT<internal::Matrix6d> solver(poses);
  if (solver.info() != Eigen::Success || !solver.isPositive()) return {};
  const Vector6d mixed = equations.hessian.topRightCorner<6, 1>();
  const Vector6d elimination = solver.solve(mixed);
  ReadoutFit fit;
  fit.information = equations.hessian(6, 6) - mixed.dot(elimination);
  const double gradient = equations.gradient[6] - elimination.dot(equations.gradient.head<6>());
  if (!(fit.information > 0)) return {};
  fit.correction = -gradient / fit.information;
  return fit;
}

}  // namespace semslam

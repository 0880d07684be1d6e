// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/camera/pinhole_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "semslam/base/check.h"

namespace semslam {
namespace {

// Brown's model on the normalised image plane.
Eigen::Vector2d DistortNormalised(const PinholeCamera::Parameters& c, const Eigen::Vector2d& p) {
  const double r2 = p.squaredNorm();
  const double radial = 1.0 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3));
  const double xy = p.x() * p.y();
  return {p.x() * radial + 2.0 * c.p1 * xy + c.p2 * (r2 + 2.0 * p.x() * p.x()),
          p.y() * radial + c.p1 * (r2 + 2.0 * p.y() * p.y()) + 2.0 * c.p2 * xy};
}

// Its derivative; symmetric.
struct SymmetricJacobian {
  double xx, xy, yy;
};
SymmetricJacobian DistortionJacobian(const PinholeCamera::Parameters& c, const Eigen::Vector2d& p) {
  const double r2 = p.squaredNorm();
  const double radial = 1.0 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3));
  const double twice_slope = 2.0 * (c.k1 + r2 * (2.0 * c.k2 + r2 * 3.0 * c.k3));
  const double x = p.x();
  const double y = p.y();
  return {radial + x * x * twice_slope + 2.0 * c.p1 * y + 6.0 * c.p2 * x,
          x * y * twice_slope + 2.0 * c.p1 * x + 2.0 * c.p2 * y,
          radial + y * y * twice_slope + 6.0 * c.p1 * y + 2.0 * c.p2 * x};
}

// Newton's step; or, where the distortion folds the image, as if there were none.
Eigen::Vector2d StepAgainst(const Eigen::Vector2d& error, const SymmetricJacobian& j) {
  constexpr double kMinDeterminant = 0.01;
  const double determinant = j.xx * j.yy - j.xy * j.xy;
  if (!(determinant > kMinDeterminant)) return error;
  return Eigen::Vector2d(j.yy * error.x() - j.xy * error.y(), j.xx * error.y() - j.xy * error.x()) /
         determinant;
}

}  // namespace

PinholeCamera::PinholeCamera(const Parameters& parameters) : parameters_(parameters) {
  const Parameters& p = parameters_;
  SEMSLAM_CHECK(p.width > 0 && p.height > 0) << "size " << p.width << "x" << p.height;
  SEMSLAM_CHECK(p.fx > 0 && p.fy > 0) << "focal length " << p.fx << ", " << p.fy;
  for (const double value : {p.fx, p.fy, p.cx, p.cy, p.k1, p.k2, p.p1, p.p2, p.k3}) {
    SEMSLAM_CHECK(std::isfinite(value)) << "camera parameter " << value;
  }
  ideal_bounds_ = ComputeIdealBounds();
}

bool PinholeCamera::has_distortion() const {
  const Parameters& p = parameters_;
  return p.k1 != 0 || p.k2 != 0 || p.p1 != 0 || p.p2 != 0 || p.k3 != 0;
}

Eigen::Vector2d PinholeCamera::Distort(const Eigen::Vector2d& ideal_pixel) const {
  if (!has_distortion()) return ideal_pixel;
  const Eigen::Vector2d p = DistortNormalised(
      parameters_, {(ideal_pixel.x() - cx()) / fx(), (ideal_pixel.y() - cy()) / fy()});
  return {fx() * p.x() + cx(), fy() * p.y() + cy()};
}

Eigen::Vector2d PinholeCamera::Undistort(const Eigen::Vector2d& raw_pixel) const {
  if (!has_distortion()) return raw_pixel;
  const Eigen::Vector2d target{(raw_pixel.x() - cx()) / fx(), (raw_pixel.y() - cy()) / fy()};
  // Newton's method: after a step from an error so small, the next one is below rounding.
  constexpr double kSmallError = 1e-8;
  constexpr int kMaxIterations = 50;
  Eigen::Vector2d p = target;
  for (int i = 0; i < kMaxIterations; ++i) {
    const Eigen::Vector2d error = DistortNormalised(parameters_, p) - target;
    p -= StepAgainst(error, DistortionJacobian(parameters_, p));
    if (error.cwiseAbs().maxCoeff() < kSmallError) break;
  }
  return {fx() * p.x() + cx(), fy() * p.y() + cy()};
}

PinholeCamera::Bounds PinholeCamera::ComputeIdealBounds() const {
  if (!has_distortion()) return {0, 0, width() - 1.0, height() - 1.0};
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Bounds bounds{kInfinity, kInfinity, -kInfinity, -kInfinity};
  const auto include = [&](double x, double y) {
    const Eigen::Vector2d ideal = Undistort({x, y});
    bounds.min_x = std::min(bounds.min_x, ideal.x());
    bounds.max_x = std::max(bounds.max_x, ideal.x());
    bounds.min_y = std::min(bounds.min_y, ideal.y());
    bounds.max_y = std::max(bounds.max_y, ideal.y());
  };
  for (int x = 0; x < width(); ++x) {
    include(x, 0);
    include(x, height() - 1.0);
  }
  for (int y = 0; y < height(); ++y) {
    include(0, y);
    include(width() - 1.0, y);
  }
  return bounds;
}

RayTable::RayTable(const PinholeCamera& camera) : width_(camera.width()), height_(camera.height()) {
  rays_.reserve(static_cast<std::size_t>(width_) * height_);
  for (int row = 0; row < height_; ++row) {
    for (int column = 0; column < width_; ++column) {
      const Eigen::Vector2d ideal =
          camera.Undistort({static_cast<double>(column), static_cast<double>(row)});
      rays_.push_back(camera.Unproject(ideal, 1.0).head<2>().cast<float>());
    }
  }
}

}  // namespace semslam

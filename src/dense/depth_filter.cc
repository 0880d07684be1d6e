// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/dense/depth_filter.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <opencv2/imgproc.hpp>

#include "semslam/base/check.h"
#include "semslam/base/error.h"

namespace semslam {
namespace {

constexpr double kMaxResidualSteps = 2.0;  // Beyond this many depth steps: another surface.

// Angle between the rays of neighbouring pixels at the image centre, radians.
float PixelAngle(const RayTable& rays) {
  const int column = rays.width() / 2;
  const int row = rays.height() / 2;
  return (rays.At(column, row) - rays.At(column - 1, row)).norm();
}

cv::Mat KeepRange(const cv::Mat& depth, const DepthFilterOptions& options) {
  cv::Mat kept = depth.clone();
  const auto low = static_cast<float>(options.min_depth);
  const auto high = static_cast<float>(options.max_depth);
  for (int row = 0; row < kept.rows; ++row) {
    auto* z = kept.ptr<float>(row);
    for (int column = 0; column < kept.cols; ++column) {
      if (!(z[column] >= low && z[column] <= high)) z[column] = 0;  // NaN too.
    }
  }
  return kept;
}

// Marks both pixels of neighbouring pairs whose depths differ more than one surface can.
cv::Mat FindJumps(const cv::Mat& depth, float slope, float step) {
  cv::Mat jumps = cv::Mat::zeros(depth.size(), CV_8UC1);
  for (int row = 0; row < depth.rows; ++row) {
    const bool last_row = row + 1 == depth.rows;
    const auto* z = depth.ptr<float>(row);
    const auto* z_below = last_row ? z : depth.ptr<float>(row + 1);
    auto* mark = jumps.ptr<std::uint8_t>(row);
    auto* mark_below = last_row ? mark : jumps.ptr<std::uint8_t>(row + 1);
    const auto compare = [&](int column, float other, std::uint8_t& other_mark) {
      const float nearest = std::min(z[column], other);
      if (nearest > 0 && std::abs(z[column] - other) > nearest * (slope + 2.0F * step * nearest)) {
        mark[column] = other_mark = 255;
      }
    };
    for (int column = 0; column < depth.cols; ++column) {
      if (column + 1 < depth.cols) compare(column, z[column + 1], mark[column + 1]);
      if (last_row) continue;
      compare(column, z_below[column], mark_below[column]);
      if (column > 0) compare(column, z_below[column - 1], mark_below[column - 1]);
      if (column + 1 < depth.cols) compare(column, z_below[column + 1], mark_below[column + 1]);
    }
  }
  return jumps;
}

// Sums of a linear fit of inverse depth over ray offsets (x, y) from the window's centre.
struct PlaneSums {
  int num = 0;
  float x = 0, y = 0, i = 0, xx = 0, xy = 0, yy = 0, xi = 0, yi = 0, ii = 0;

  void Add(float dx, float dy, float di) {
    ++num;
    x += dx;
    y += dy;
    i += di;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
    xi += dx * di;
    yi += dy * di;
    ii += di * di;
  }
};

// inverse depth = a dx + b dy + c, and the sum of squared residuals.
struct PlaneFit {
  float a = 0, b = 0, c = 0, squared_residuals = 0;
  bool valid = false;
};

PlaneFit Solve(const PlaneSums& sums) {
  const float inverse = 1.0F / static_cast<float>(sums.num);
  const float xx = sums.xx - sums.x * sums.x * inverse;
  const float xy = sums.xy - sums.x * sums.y * inverse;
  const float yy = sums.yy - sums.y * sums.y * inverse;
  const float xi = sums.xi - sums.x * sums.i * inverse;
  const float yi = sums.yi - sums.y * sums.i * inverse;
  const float determinant = xx * yy - xy * xy;
  PlaneFit fit;
  // Samples on a line (an object's rim) do not define a plane.
  const float trace = xx + yy;
  fit.valid = determinant > 0.02F * trace * trace;
  if (!fit.valid) return fit;
  fit.a = (yy * xi - xy * yi) / determinant;
  fit.b = (xx * yi - xy * xi) / determinant;
  fit.c = (sums.i - fit.a * sums.x - fit.b * sums.y) * inverse;
  const float ii = sums.ii - sums.i * sums.i * inverse;
  fit.squared_residuals = std::max(0.0F, ii - fit.a * xi - fit.b * yi);
  return fit;
}

// Fits the planes of one image's windows.
class WindowFitter {
 public:
  WindowFitter(const cv::Mat& depth, const RayTable& rays, const DepthFilterOptions& options)
      : rays_(rays),
        radius_(options.normal_radius),
        spacing_(options.normal_spacing),
        step_(static_cast<float>(options.depth_step_at_1m)),
        slope_(static_cast<float>(std::tan(options.max_grazing_angle)) * 0.6F),
        min_cosine_(static_cast<float>(std::cos(options.max_grazing_angle))) {
    const int side = 2 * radius_ + 1;
    min_samples_ = std::max(6, static_cast<int>(options.min_normal_sample_share * side * side));
    inverse_depth_.create(depth.size(), CV_32FC1);
    for (int row = 0; row < depth.rows; ++row) {
      const auto* z = depth.ptr<float>(row);
      auto* inverse = inverse_depth_.ptr<float>(row);
      for (int column = 0; column < depth.cols; ++column) {
        inverse[column] = z[column] > 0 ? 1.0F / z[column] : 0.0F;
      }
    }
  }

  Eigen::Vector3f NormalAt(int column, int row) const {
    const float centre = inverse_depth_.at<float>(row, column);
    if (centre == 0) return Eigen::Vector3f::Zero();
    PlaneSums sums = SumAround(column, row, centre, nullptr);
    if (sums.num < min_samples_) return Eigen::Vector3f::Zero();
    PlaneFit fit = Solve(sums);
    const float allowed = static_cast<float>(sums.num) * step_ * step_;
    if (fit.valid && fit.squared_residuals > allowed) {
      sums = SumAround(column, row, centre, &fit);
      if (sums.num < min_samples_) return Eigen::Vector3f::Zero();
      fit = Solve(sums);
    }
    return fit.valid ? ToNormal(fit, centre, rays_.At(column, row)) : Eigen::Vector3f::Zero();
  }

 private:
  // With `fit`: only samples near that plane. Without: those that a surface through the centre can
  // reach.
  PlaneSums SumAround(int column, int row, float centre, const PlaneFit* fit) const {
    const Eigen::Vector2f& ray_centre = rays_.At(column, row);
    const float max_residual = static_cast<float>(kMaxResidualSteps) * step_;
    PlaneSums sums;
    for (int j = -radius_; j <= radius_; ++j) {
      const int y = row + j * spacing_;
      if (y < 0 || y >= inverse_depth_.rows) continue;
      const auto* inverse = inverse_depth_.ptr<float>(y);
      for (int i = -radius_; i <= radius_; ++i) {
        const int x = column + i * spacing_;
        if (x < 0 || x >= inverse_depth_.cols || inverse[x] == 0) continue;
        const float dx = rays_.At(x, y).x() - ray_centre.x();
        const float dy = rays_.At(x, y).y() - ray_centre.y();
        const float di = inverse[x] - centre;
        const float expected = fit == nullptr ? 0.0F : fit->a * dx + fit->b * dy + fit->c;
        const float tolerance = fit == nullptr
                                    ? centre * slope_ * (std::abs(dx) + std::abs(dy)) + max_residual
                                    : max_residual;
        if (std::abs(di - expected) <= tolerance) sums.Add(dx, dy, di);
      }
    }
    return sums;
  }

  // 1/z = a (x - x0) + b (y - y0) + c + 1/z0 is the plane n.(x, y, 1) = 1/z with n below.
  Eigen::Vector3f ToNormal(const PlaneFit& fit, float centre, const Eigen::Vector2f& ray) const {
    const Eigen::Vector3f away(fit.a, fit.b, centre + fit.c - fit.a * ray.x() - fit.b * ray.y());
    const Eigen::Vector3f normal = -away.normalized();
    const Eigen::Vector3f view(ray.x(), ray.y(), 1.0F);
    const float cosine = -normal.dot(view) / view.norm();
    return cosine >= min_cosine_ ? normal : Eigen::Vector3f::Zero();
  }

  const RayTable& rays_;
  int radius_;
  int spacing_;
  float step_;
  float slope_;
  float min_cosine_;
  int min_samples_ = 0;
  cv::Mat inverse_depth_;
};

void Require(bool holds, const std::string& what) {
  if (!holds) throw InputError("depth filter: " + what);
}

}  // namespace

void DepthFilterOptions::Validate() const {
  Require(min_depth > 0 && max_depth > min_depth, "expected 0 < min_depth < max_depth");
  Require(depth_step_at_1m > 0, "expected depth_step_at_1m > 0");
  Require(max_grazing_angle > 0 && max_grazing_angle < 1.57,
          "expected 0 < max_grazing_angle < 1.57");
  Require(edge_margin >= 0 && edge_margin <= 20, "expected 0 <= edge_margin <= 20");
  Require(normal_radius >= 1 && normal_radius <= 20, "expected 1 <= normal_radius <= 20");
  Require(normal_spacing >= 1 && normal_spacing <= 20, "expected 1 <= normal_spacing <= 20");
  Require(min_normal_sample_share > 0 && min_normal_sample_share <= 1,
          "expected 0 < min_normal_sample_share <= 1");
}

cv::Mat FilterDepth(const cv::Mat& depth, const RayTable& rays, const DepthFilterOptions& options) {
  SEMSLAM_CHECK(depth.type() == CV_32FC1) << "type " << depth.type();
  SEMSLAM_CHECK(depth.cols == rays.width() && depth.rows == rays.height())
      << depth.cols << 'x' << depth.rows << ", rays " << rays.width() << 'x' << rays.height();
  cv::Mat filtered = KeepRange(depth, options);
  if (options.edge_margin == 0) return filtered;
  // Depth change from pixel to pixel, over the depth, on a surface at the largest angle.
  const float slope = PixelAngle(rays) * static_cast<float>(std::tan(options.max_grazing_angle));
  cv::Mat jumps = FindJumps(depth, slope, static_cast<float>(options.depth_step_at_1m));
  if (options.edge_margin > 1) {
    const int side = 2 * options.edge_margin - 1;  // The marks already cover a pixel on both sides.
    cv::dilate(jumps, jumps, cv::Mat::ones(side, side, CV_8UC1));
  }
  filtered.setTo(0, jumps);
  return filtered;
}

std::vector<Eigen::Vector3f> EstimateNormals(const cv::Mat& filtered_depth,
                                             const RayTable& rays,
                                             int stride,
                                             const DepthFilterOptions& options) {
  SEMSLAM_CHECK(stride >= 1) << "stride = " << stride;
  SEMSLAM_CHECK(filtered_depth.cols == rays.width() && filtered_depth.rows == rays.height());
  const WindowFitter fitter(filtered_depth, rays, options);
  std::vector<Eigen::Vector3f> normals;
  const auto ceil_divide = [stride](int size) { return (size + stride - 1) / stride; };
  normals.reserve(static_cast<std::size_t>(ceil_divide(rays.width())) *
                  static_cast<std::size_t>(ceil_divide(rays.height())));
  for (int row = 0; row < rays.height(); row += stride) {
    for (int column = 0; column < rays.width(); column += stride) {
      normals.push_back(fitter.NormalAt(column, row));
    }
  }
  return normals;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/point_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "semslam/base/check.h"

namespace semslam {
namespace {

constexpr float kMinDepth = 0.05F;  // Metres; nearer points are not drawn.

void DrawDisc(const Eigen::Vector2f& center,
              float radius,
              float depth,
              std::int32_t index,
              PointImage& image) {
  const int first_x = std::max(0, static_cast<int>(std::ceil(center.x() - radius)));
  const int last_x =
      std::min(image.depths.cols - 1, static_cast<int>(std::floor(center.x() + radius)));
  const int first_y = std::max(0, static_cast<int>(std::ceil(center.y() - radius)));
  const int last_y =
      std::min(image.depths.rows - 1, static_cast<int>(std::floor(center.y() + radius)));
  for (int y = first_y; y <= last_y; ++y) {
    auto* depths = image.depths.ptr<float>(y);
    auto* points = image.points.ptr<std::int32_t>(y);
    const float dy = static_cast<float>(y) - center.y();
    for (int x = first_x; x <= last_x; ++x) {
      const float dx = static_cast<float>(x) - center.x();
      if (dx * dx + dy * dy > radius * radius || depth >= depths[x]) continue;
      depths[x] = depth;
      points[x] = index;
    }
  }
}

// The first pixel with a point within a few steps; nothing if there is none.
std::optional<cv::Point> FindPoint(const cv::Mat& points, cv::Point pixel, cv::Point step) {
  constexpr int kMaxSteps = 4;
  const cv::Rect bounds(0, 0, points.cols, points.rows);
  for (int i = 0; i < kMaxSteps; ++i) {
    pixel += step;
    if (!bounds.contains(pixel)) return std::nullopt;
    if (points.at<std::int32_t>(pixel) != PointImage::kNone) return pixel;
  }
  return std::nullopt;
}

// Gives a pixel without a point the point beside it, if it lies in a gap of a surface: with points
// of about the same depth on both sides along two of the four axes. Far surfaces have such gaps.
void FillGaps(PointImage& image) {
  const cv::Mat points = image.points.clone();
  const cv::Mat depths = image.depths.clone();
  const std::array<cv::Point, 4> axes = {{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
  constexpr float kMaxRatio = 1.05F;
  constexpr int kMinAxes = 2;
  for (int y = 0; y < points.rows; ++y) {
    for (int x = 0; x < points.cols; ++x) {
      if (points.at<std::int32_t>(y, x) != PointImage::kNone) continue;
      int num_axes = 0;
      for (const cv::Point& axis : axes) {
        const std::optional<cv::Point> a = FindPoint(points, {x, y}, axis);
        const std::optional<cv::Point> b = a ? FindPoint(points, {x, y}, -axis) : std::nullopt;
        if (!b) continue;
        const auto [near, far] = std::minmax(depths.at<float>(*a), depths.at<float>(*b));
        if (far > kMaxRatio * near || ++num_axes < kMinAxes) continue;
        image.points.at<std::int32_t>(y, x) = points.at<std::int32_t>(*a);
        image.depths.at<float>(y, x) = depths.at<float>(*a);
        break;
      }
    }
  }
}

// Eye-dome lighting (Boucheny 2009): a pixel is darker, the more its neighbours are in front of it,
// by the logarithm of their depths, so that it does not depend on the scale.
cv::Mat EyeDomeLighting(const cv::Mat& depths, int radius) {
  cv::Mat log_depths(depths.size(), CV_32FC1);
  for (int y = 0; y < depths.rows; ++y) {
    for (int x = 0; x < depths.cols; ++x) {
      log_depths.at<float>(y, x) = std::log2(depths.at<float>(y, x));
    }
  }
  constexpr float kStrength = 12.0F;
  constexpr float kMinStep = 0.008F;  // Noise of depth, and discs that overlap.
  constexpr float kMaxStep = 0.15F;   // So that a far background does not turn black.
  const std::array<cv::Point, 8> offsets = {{{radius, 0},
                                             {-radius, 0},
                                             {0, radius},
                                             {0, -radius},
                                             {radius, radius},
                                             {-radius, radius},
                                             {radius, -radius},
                                             {-radius, -radius}}};
  cv::Mat lighting(depths.size(), CV_32FC1, cv::Scalar(1.0));
  for (int y = 0; y < depths.rows; ++y) {
    for (int x = 0; x < depths.cols; ++x) {
      const float own = log_depths.at<float>(y, x);
      if (!std::isfinite(own)) continue;
      float sum = 0;
      for (const cv::Point& offset : offsets) {
        const cv::Point p(std::clamp(x + offset.x, 0, depths.cols - 1),
                          std::clamp(y + offset.y, 0, depths.rows - 1));
        sum += std::clamp(own - log_depths.at<float>(p) - kMinStep, 0.0F, kMaxStep);
      }
      lighting.at<float>(y, x) = std::exp(-kStrength * sum / static_cast<float>(offsets.size()));
    }
  }
  return lighting;
}

}  // namespace

PointImage RenderPoints(std::span<const Eigen::Vector3f> positions,
                        const ViewCamera& camera,
                        double point_size) {
  PointImage image;
  image.points = cv::Mat(camera.height, camera.width, CV_32SC1, cv::Scalar(PointImage::kNone));
  image.depths = cv::Mat(camera.height, camera.width, CV_32FC1,
                         cv::Scalar(std::numeric_limits<float>::infinity()));
  // Discs of neighbours on a grid of this spacing cover all between them: half its diagonal.
  const auto radius_at_one_metre = static_cast<float>(0.72 * point_size) * camera.focal_length;
  constexpr float kMinRadius = 0.8F;
  constexpr float kMaxRadius = 40.0F;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Eigen::Vector3f p_camera = camera.ToCamera(positions[i]);
    if (!(p_camera.z() > kMinDepth)) continue;  // Also not a number.
    const float radius = std::clamp(radius_at_one_metre / p_camera.z(), kMinRadius, kMaxRadius);
    const Eigen::Vector2f center = camera.Project(p_camera);
    const bool is_near_picture = center.x() > -radius && center.y() > -radius &&
                                 center.x() < static_cast<float>(camera.width) + radius &&
                                 center.y() < static_cast<float>(camera.height) + radius;
    if (!is_near_picture) continue;
    DrawDisc(center, radius, p_camera.z(), static_cast<std::int32_t>(i), image);
  }
  FillGaps(image);
  image.lighting = EyeDomeLighting(image.depths, std::max(1, camera.width / 700));
  return image;
}

}  // namespace semslam

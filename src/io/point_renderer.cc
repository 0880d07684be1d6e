// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/point_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "semslam/base/check.h"

namespace semslam {
namespace {

// Share of the points that may lie outside of each edge of the picture.
constexpr double kOutsideShare = 0.025;
constexpr float kMinDepth = 0.05F;  // Metres; nearer points are not drawn.

// The value that only so small a share of the values exceeds.
float UpperQuantile(std::vector<float>& values, double share) {
  const std::size_t last = values.size() - 1;
  const auto rank =
      static_cast<std::ptrdiff_t>(std::lround((1.0 - share) * static_cast<double>(last)));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

// Along one axis of the picture: where the camera must stand so that the points fit between two
// lines of slope +-slope through it. A point (x, z) is inside if |x - camera_x| <= slope * (z -
// camera_z): two lower bounds, of which both are met with equality by the answer.
struct AxisFit {
  float position = 0;
  float depth = 0;
};

AxisFit FitAxis(const std::vector<Eigen::Vector3f>& points, int axis, float slope) {
  std::vector<float> right;
  std::vector<float> left;
  for (const Eigen::Vector3f& p : points) {
    right.push_back(p[axis] - slope * p.z());
    left.push_back(-p[axis] - slope * p.z());
  }
  const float right_bound = UpperQuantile(right, kOutsideShare);
  const float left_bound = UpperQuantile(left, kOutsideShare);
  return {0.5F * (right_bound - left_bound), -0.5F * (right_bound + left_bound) / slope};
}

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

ViewCamera FitCamera(std::span<const Eigen::Vector3f> positions,
                     const Eigen::Vector3f& forward,
                     const Eigen::Vector3f& up,
                     float field_of_view,
                     int width,
                     int height) {
  ViewCamera camera;
  camera.width = width;
  camera.height = height;
  camera.focal_length = 0.5F * static_cast<float>(width) / std::tan(0.5F * field_of_view);
  const Eigen::Vector3f z = forward.normalized();
  const Eigen::Vector3f x = z.cross(up).normalized();
  camera.R_camera_world << x.transpose(), z.cross(x).transpose(), z.transpose();

  std::vector<Eigen::Vector3f> rotated;
  for (const Eigen::Vector3f& p : positions) {
    if (p.allFinite()) rotated.push_back(camera.R_camera_world * p);
  }
  SEMSLAM_CHECK(!rotated.empty()) << "no points";
  constexpr float kUsed = 0.92F;  // Of the picture; the rest is margin.
  const AxisFit fit_x =
      FitAxis(rotated, 0, kUsed * 0.5F * static_cast<float>(width) / camera.focal_length);
  const AxisFit fit_y =
      FitAxis(rotated, 1, kUsed * 0.5F * static_cast<float>(height) / camera.focal_length);
  constexpr float kMinDistance = 0.2F;  // Metres, for a cloud of one point.
  const float depth = std::min(fit_x.depth, fit_y.depth) - kMinDistance;
  camera.p_world =
      camera.R_camera_world.transpose() * Eigen::Vector3f(fit_x.position, fit_y.position, depth);
  return camera;
}

std::optional<Eigen::Vector3f> CommonUpNormal(std::span<const Eigen::Vector3f> normals,
                                              const Eigen::Vector3f& about_up) {
  // Candidates evenly over the sphere (Fibonacci lattice); each normal votes for those within 8
  // degrees. The average of the winner's normals is the answer.
  constexpr int kNumCandidates = 1500;
  const float min_cosine = std::cos(8.0F * 3.14159265F / 180.0F);
  std::vector<Eigen::Vector3f> candidates;
  for (int i = 0; i < kNumCandidates; ++i) {
    const float z = 1.0F - (2.0F * static_cast<float>(i) + 1.0F) / kNumCandidates;
    const double angle = i * 2.399963229728653;  // Golden angle.
    const float radius = std::sqrt(1.0F - z * z);
    const Eigen::Vector3f direction(radius * static_cast<float>(std::cos(angle)),
                                    radius * static_cast<float>(std::sin(angle)), z);
    if (direction.dot(about_up.normalized()) > 0.5F) candidates.push_back(direction);
  }
  constexpr std::size_t kMaxVoters = 20000;
  const std::size_t step = std::max<std::size_t>(1, normals.size() / kMaxVoters);
  std::vector<int> votes(candidates.size());
  std::vector<Eigen::Vector3f> sums(candidates.size(), Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i < normals.size(); i += step) {
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      if (!(normals[i].dot(candidates[k]) > min_cosine)) continue;
      ++votes[k];
      sums[k] += normals[i];
    }
  }
  const auto best = std::max_element(votes.begin(), votes.end());
  constexpr double kMinShare = 0.02;
  const double num_voters = static_cast<double>(normals.size()) / static_cast<double>(step);
  if (best == votes.end() || *best < std::max(1.0, kMinShare * num_voters)) return std::nullopt;
  return sums[static_cast<std::size_t>(best - votes.begin())].normalized();
}

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

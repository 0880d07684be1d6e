// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/semantics/label_baselines.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "semslam/base/check.h"

namespace semslam {
namespace {

// The pixel of the recorded image that holds a point.
std::optional<cv::Point> PixelOf(const Eigen::Vector3d& p_camera, const PinholeCamera& camera) {
  if (p_camera.z() <= 0) return std::nullopt;
  // The distortion's polynomial folds points from far outside back into the image.
  const Eigen::Vector2d ideal = camera.Project(p_camera);
  if (!camera.ideal_bounds().Contains(ideal)) return std::nullopt;
  const Eigen::Vector2d raw = camera.Distort(ideal);
  const cv::Point pixel(static_cast<int>(std::lround(raw.x())),
                        static_cast<int>(std::lround(raw.y())));
  if (!cv::Rect(0, 0, camera.width(), camera.height()).contains(pixel)) return std::nullopt;
  return pixel;
}

int LastClassAt(const std::vector<Detection>& detections, const cv::Point& pixel) {
  const auto last = std::find_if(
      detections.rbegin(), detections.rend(),
      [&](const Detection& detection) { return detection.box.ContainsPixel(pixel.x, pixel.y); });
  return last == detections.rend() ? kNoClass : last->class_id;
}

int BestClassAt(const std::vector<Detection>& detections, const cv::Point& pixel) {
  const Detection* best = nullptr;
  for (const Detection& detection : detections) {
    if (!detection.box.ContainsPixel(pixel.x, pixel.y)) continue;
    if (best == nullptr || detection.score > best->score) best = &detection;
  }
  return best == nullptr ? kNoClass : best->class_id;
}

std::size_t ColumnOf(int class_id) { return static_cast<std::size_t>(class_id - kNoClass); }

int MostVoted(std::span<const std::uint32_t> votes) {
  const auto best = std::max_element(votes.begin() + 1, votes.end());
  if (best == votes.end() || *best == 0 || *best < votes.front()) return kNoClass;
  return static_cast<int>(best - votes.begin()) + kNoClass;
}

}  // namespace

void LabelBaselines::Options::Validate() const {
  if (!(max_depth_error >= 0 && depth_error_at_1m >= 0)) {
    throw std::invalid_argument("label baselines: depth errors must not be negative");
  }
}

LabelBaselines::LabelBaselines(std::span<const Eigen::Vector3f> positions,
                               const PinholeCamera& camera,
                               std::size_t num_classes,
                               const Options& options)
    : positions_(positions),
      camera_(camera),
      num_columns_(num_classes + 1),
      options_(options),
      painted_(positions.size(), kNoClass),
      votes_(positions.size() * num_columns_) {
  options_.Validate();
}

void LabelBaselines::AddView(const DetectedView& view) {
  SEMSLAM_CHECK(view.depth.type() == CV_32FC1 && view.depth.cols == camera_.width() &&
                view.depth.rows == camera_.height());
  const Rigid3 T_camera_world = view.T_world_camera.Inverse();
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    const Eigen::Vector3d p_camera = T_camera_world * positions_[i].cast<double>();
    const std::optional<cv::Point> pixel = PixelOf(p_camera, camera_);
    if (!pixel) continue;
    const double depth = view.depth.at<float>(*pixel);
    const double max_error =
        options_.max_depth_error + options_.depth_error_at_1m * p_camera.z() * p_camera.z();
    if (depth <= 0 || std::abs(depth - p_camera.z()) > max_error) continue;
    painted_[i] = LastClassAt(view.detections, *pixel);
    ++votes_[i * num_columns_ + ColumnOf(BestClassAt(view.detections, *pixel))];
  }
}

std::vector<int> LabelBaselines::PointVotes() const {
  std::vector<int> classes;
  classes.reserve(positions_.size());
  for (std::size_t i = 0; i < positions_.size(); ++i) classes.push_back(MostVoted(VotesOf(i)));
  return classes;
}

std::vector<int> LabelBaselines::SegmentVotes(std::span<const std::uint32_t> segments) const {
  SEMSLAM_CHECK(segments.size() == positions_.size());
  const std::uint32_t last =
      segments.empty() ? 0 : *std::max_element(segments.begin(), segments.end());
  std::vector<std::uint32_t> sums((last + std::size_t{1}) * num_columns_);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Votes votes = VotesOf(i);
    for (std::size_t k = 0; k < votes.size(); ++k) sums[segments[i] * num_columns_ + k] += votes[k];
  }
  std::vector<int> classes;
  classes.reserve(segments.size());
  for (const std::uint32_t segment : segments) {
    classes.push_back(segment == 0 ? kNoClass
                                   : MostVoted(std::span<const std::uint32_t>(sums).subspan(
                                         segment * num_columns_, num_columns_)));
  }
  return classes;
}

}  // namespace semslam

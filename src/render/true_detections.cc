// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "semslam/render/clip_writer.h"
#include "semslam/render/hash.h"

namespace semslam {
namespace {

constexpr std::uint64_t kDetectionStream = 0xde7ec7;

// Where an instance shows in a picture.
struct Extent {
  int num_pixels = 0;
  int left = 0;
  int top = 0;
  int right = -1;  // Inclusive.
  int bottom = -1;

  void Add(int x, int y) {
    left = num_pixels == 0 ? x : std::min(left, x);
    top = num_pixels == 0 ? y : std::min(top, y);
    right = std::max(right, x);
    bottom = std::max(bottom, y);
    ++num_pixels;
  }
};

std::vector<Extent> VisibleExtents(const cv::Mat& labels, std::size_t num_instances) {
  std::vector<Extent> extents(num_instances + 1);  // By id; ids start at 1.
  for (int y = 0; y < labels.rows; ++y) {
    const auto* row = labels.ptr<std::uint16_t>(y);
    for (int x = 0; x < labels.cols; ++x) extents[row[x]].Add(x, y);
  }
  return extents;
}

cv::Rect2d JitteredBox(const Extent& extent,
                       const cv::Size& size,
                       double jitter,
                       std::uint64_t hash) {
  const auto moved = [&](double side, double extent_size, double limit, std::uint64_t bits) {
    return std::clamp(side + jitter * extent_size * NormalFloat(bits), 0.0, limit);
  };
  const double width = extent.right + 1 - extent.left;
  const double height = extent.bottom + 1 - extent.top;
  const double left = moved(extent.left, width, size.width, MixBits(hash + 1));
  const double top = moved(extent.top, height, size.height, MixBits(hash + 2));
  const double right = moved(extent.right + 1, width, size.width, MixBits(hash + 3));
  const double bottom = moved(extent.bottom + 1, height, size.height, MixBits(hash + 4));
  return {left, top, right - left, bottom - top};
}

}  // namespace

std::vector<TrueDetection> DetectFromLabels(const cv::Mat& labels,
                                            const std::vector<Instance>& instances,
                                            std::uint64_t seed,
                                            std::uint64_t frame,
                                            const DetectionOptions& options) {
  const std::vector<Extent> extents = VisibleExtents(labels, instances.size());
  std::vector<TrueDetection> detections;
  for (const Instance& instance : instances) {
    const auto name =
        std::find(options.class_names.begin(), options.class_names.end(), instance.class_name);
    const Extent& extent = extents[instance.id];
    if (name == options.class_names.end() || extent.num_pixels < options.min_pixels) continue;
    const std::uint64_t hash = HashOf(seed ^ kDetectionStream, frame, instance.id);
    if (UnitFloat(hash) < options.miss_rate) continue;
    TrueDetection detection;
    detection.class_index = static_cast<int>(name - options.class_names.begin());
    detection.box = JitteredBox(extent, labels.size(), options.box_jitter, hash);
    if (detection.box.width < 2 || detection.box.height < 2) continue;
    // Larger objects are found with more certainty.
    const double certainty = std::min(1.0, std::sqrt(extent.num_pixels / 6000.0));
    detection.score = 0.55 + 0.3 * certainty + 0.14 * UnitFloat(MixBits(hash + 5));
    detections.push_back(detection);
  }
  return detections;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/semantics/detection.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace semslam {
namespace {

// A total order, so that the result does not depend on the order of the input.
bool IsBetter(const Detection& a, const Detection& b) {
  const auto rank = [](const Detection& d) {
    return std::make_tuple(-d.score, d.class_id, d.box.min_x, d.box.min_y, d.box.max_x,
                           d.box.max_y);
  };
  return rank(a) < rank(b);
}

bool IsUsable(const Detection& detection, std::size_t num_classes) {
  const ImageBox& box = detection.box;
  const bool finite_box = std::isfinite(box.min_x) && std::isfinite(box.min_y) &&
                          std::isfinite(box.max_x) && std::isfinite(box.max_y);
  return finite_box && std::isfinite(detection.score) && detection.score > 0 &&
         detection.class_id >= 0 && static_cast<std::size_t>(detection.class_id) < num_classes &&
         detection.class_scores.size() == num_classes;
}

}  // namespace

float ImageBox::Area() const { return std::max(0.0F, width()) * std::max(0.0F, height()); }

bool ImageBox::ContainsPixel(int column, int row) const {
  const float x = static_cast<float>(column) + 0.5F;
  const float y = static_cast<float>(row) + 0.5F;
  return x >= min_x && x < max_x && y >= min_y && y < max_y;
}

ImageBox ImageBox::ClippedTo(int image_width, int image_height) const {
  const auto right = static_cast<float>(image_width);
  const auto bottom = static_cast<float>(image_height);
  return {std::clamp(min_x, 0.0F, right), std::clamp(min_y, 0.0F, bottom),
          std::clamp(max_x, 0.0F, right), std::clamp(max_y, 0.0F, bottom)};
}

float IntersectionOverUnion(const ImageBox& a, const ImageBox& b) {
  const ImageBox common{std::max(a.min_x, b.min_x), std::max(a.min_y, b.min_y),
                        std::min(a.max_x, b.max_x), std::min(a.max_y, b.max_y)};
  const float intersection = common.Area();
  const float together = a.Area() + b.Area() - intersection;
  return together > 0 ? intersection / together : 0.0F;
}

std::vector<Detection> SuppressOverlaps(std::vector<Detection> detections, float max_overlap) {
  std::sort(detections.begin(), detections.end(), IsBetter);
  std::vector<Detection> kept;
  for (Detection& candidate : detections) {
    const bool overlaps = std::any_of(kept.begin(), kept.end(), [&](const Detection& better) {
      return better.class_id == candidate.class_id &&
             IntersectionOverUnion(better.box, candidate.box) > max_overlap;
    });
    if (!overlaps) kept.push_back(std::move(candidate));
  }
  return kept;
}

std::vector<Detection> Sanitise(std::vector<Detection> detections,
                                std::size_t num_classes,
                                int image_width,
                                int image_height,
                                std::size_t max_detections) {
  std::vector<Detection> usable;
  for (Detection& detection : detections) {
    if (!IsUsable(detection, num_classes)) continue;
    detection.box = detection.box.ClippedTo(image_width, image_height);
    if (detection.box.Area() < 1.0F) continue;
    detection.score = std::min(detection.score, 1.0F);
    for (float& score : detection.class_scores) {
      score = std::isfinite(score) ? std::clamp(score, 0.0F, 1.0F) : 0.0F;
    }
    usable.push_back(std::move(detection));
  }
  std::sort(usable.begin(), usable.end(), IsBetter);
  if (usable.size() > max_detections) usable.resize(max_detections);
  return usable;
}

}  // namespace semslam

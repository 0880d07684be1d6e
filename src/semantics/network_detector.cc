// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/semantics/network_detector.h"

#include <algorithm>
#include <utility>

#include "semslam/base/check.h"

#include "semantics/letterbox.h"
#include "semantics/network.h"

namespace semslam {
namespace {

constexpr std::size_t kMaxCandidates = 1000;  // Before suppression; a broken network has thousands.

}  // namespace

NetworkDetector::NetworkDetector(const Options& options, ClassTable classes)
    : options_(options), classes_(std::move(classes)) {
  options_.Validate();
  const auto load = options_.config.extension() == ".onnx" ? LoadOnnx : LoadDarknet;
  network_ = load(options_, classes_.size());
}

NetworkDetector::~NetworkDetector() = default;
NetworkDetector::NetworkDetector(NetworkDetector&&) noexcept = default;

std::size_t NetworkDetector::batch_size() const {
  return static_cast<std::size_t>(options_.batch_size);
}

std::vector<Detection> NetworkDetector::Detect(const RgbdImage& image) {
  return std::move(DetectAll({&image, 1}).front());
}

std::vector<std::vector<Detection>> NetworkDetector::DetectAll(std::span<const RgbdImage> images) {
  if (images.empty()) return {};
  const cv::Size size = images.front().color.size();
  std::vector<cv::Mat> pictures;
  for (const RgbdImage& image : images) {
    SEMSLAM_CHECK(!image.color.empty() && image.color.type() == CV_8UC3)
        << "type " << image.color.type();
    SEMSLAM_CHECK(image.color.size() == size) << image.color.cols << 'x' << image.color.rows;
    pictures.push_back(image.color);
  }
  const cv::Size input = network_->input_size();
  const auto place = options_.letterbox ? Letterbox::Fit : Letterbox::Stretch;
  const Letterbox letterbox = place(size.width, size.height, input.width, input.height);
  std::vector<std::vector<Detection>> found =
      network_->Run(MakeBlob(pictures, letterbox), letterbox);
  for (std::vector<Detection>& detections : found) {
    detections = SuppressOverlaps(
        Sanitise(std::move(detections), classes_.size(), size.width, size.height, kMaxCandidates),
        options_.nms_threshold);
  }
  return found;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/semantics/onnx_detector.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>

#include <opencv2/dnn.hpp>

#include "semslam/base/check.h"
#include "semslam/base/error.h"

#include "semantics/dnn_backend.h"
#include "semantics/letterbox.h"

namespace semslam {
namespace {

constexpr int kUsualInputSize = 640;          // Of exported networks.
constexpr std::size_t kMaxCandidates = 1000;  // Before suppression.
constexpr int kBoxValues = 4;                 // Centre x, y, width, height.

std::string ShapeOf(const cv::Mat& output) {
  std::string shape;
  for (int i = 0; i < output.dims; ++i)
    shape += (i == 0 ? "" : " x ") + std::to_string(output.size[i]);
  return shape;
}

// A line for each box: its four values, objectness if `has_objectness`, the classes.
struct Rows {
  cv::Mat values;  // CV_32FC1.
  bool has_objectness = false;
};

// Class scores times objectness, those below min_class_score cut to 0.
std::vector<float> ClassScores(const float* row,
                               const Rows& rows,
                               int num_classes,
                               float min_class_score) {
  const float objectness = rows.has_objectness ? row[kBoxValues] : 1.0F;
  const float* scores = row + kBoxValues + (rows.has_objectness ? 1 : 0);
  std::vector<float> result(scores, scores + num_classes);
  for (float& score : result)
    score = score * objectness >= min_class_score ? score * objectness : 0;
  return result;
}

// False for most rows, at little cost; also for NaN.
bool MayPass(const float* row, const Rows& rows, int num_classes, float score_threshold) {
  if (rows.has_objectness) return row[kBoxValues] >= score_threshold;
  return std::any_of(row + kBoxValues, row + kBoxValues + num_classes,
                     [=](float score) { return score >= score_threshold; });
}

std::vector<Detection> DecodeAll(const Rows& rows,
                                 const Letterbox& letterbox,
                                 int num_classes,
                                 const NetworkOptions& options) {
  const auto width = static_cast<float>(letterbox.input_width);
  const auto height = static_cast<float>(letterbox.input_height);
  std::vector<Detection> detections;
  for (int i = 0; i < rows.values.rows; ++i) {
    const auto* row = rows.values.ptr<float>(i);
    if (!MayPass(row, rows, num_classes, options.score_threshold)) continue;
    Detection detection;
    detection.class_scores = ClassScores(row, rows, num_classes, options.min_class_score);
    const auto best =
        std::max_element(detection.class_scores.begin(), detection.class_scores.end());
    if (*best < options.score_threshold) continue;
    detection.class_id = static_cast<int>(best - detection.class_scores.begin());
    detection.score = *best;
    detection.box =
        letterbox.ToImage(row[0] / width, row[1] / height, row[2] / width, row[3] / height);
    detections.push_back(std::move(detection));
  }
  return detections;
}

}  // namespace

class OnnxDetector::Network {
 public:
  Network(const Options& options, int num_classes)
      : file_(options.config.string()),
        size_(options.input_size > 0 ? options.input_size : kUsualInputSize),
        num_classes_(num_classes) {
    if (!std::filesystem::is_regular_file(options.config))
      throw InputError(file_ + ": cannot open the network");
    try {
      net_ = cv::dnn::readNetFromONNX(file_);
    } catch (const cv::Exception& error) {
      throw InputError(file_ + ": OpenCV cannot read the network: " + error.err);
    }
    SelectBackend(net_, options.backend, options.target);
    // OpenCV allocates at the first run, and only then are shapes known.
    const cv::Mat grey(size_, size_, CV_8UC3, cv::Scalar(128, 128, 128));
    try {
      Forward(MakeBlob(grey, Letterbox::Fit(size_, size_, size_, size_)));
    } catch (const cv::Exception& error) {
      throw InputError(file_ + ": OpenCV cannot run the network with an input of " +
                       std::to_string(size_) + " x " + std::to_string(size_) +
                       " pixels (Detector.inputSize): " + error.err);
    }
  }

  int size() const { return size_; }

  // Throws InputError if the output has none of the known forms.
  Rows Forward(const cv::Mat& blob) {
    net_.setInput(blob);
    const cv::Mat output = net_.forward();
    if (output.dims == 3 && output.size[0] == 1 && output.type() == CV_32FC1) {
      const cv::Mat plane(output.size[1], output.size[2], CV_32FC1,
                          const_cast<uchar*>(output.data));
      if (plane.cols == kBoxValues + 1 + num_classes_) return {plane.clone(), true};
      if (plane.rows == kBoxValues + num_classes_) return {plane.t(), false};
    }
    throw InputError(file_ + ": expected an output of 1 x boxes x " +
                     std::to_string(kBoxValues + 1 + num_classes_) + " or 1 x " +
                     std::to_string(kBoxValues + num_classes_) + " x boxes for " +
                     std::to_string(num_classes_) + " class names, found " + ShapeOf(output));
  }

 private:
  std::string file_;
  int size_;
  int num_classes_;
  cv::dnn::Net net_;
};

OnnxDetector::OnnxDetector(const Options& options, ClassTable classes)
    : options_(options), classes_(std::move(classes)) {
  options_.Validate();
  network_ = std::make_unique<Network>(options_, static_cast<int>(classes_.size()));
}

OnnxDetector::~OnnxDetector() = default;

std::vector<Detection> OnnxDetector::Detect(const RgbdImage& image) {
  const cv::Mat& color = image.color;
  SEMSLAM_CHECK(!color.empty() && color.type() == CV_8UC3) << "type " << color.type();
  const int num_classes = static_cast<int>(classes_.size());
  const auto place = options_.letterbox ? Letterbox::Fit : Letterbox::Stretch;
  const Letterbox letterbox = place(color.cols, color.rows, network_->size(), network_->size());
  std::vector<Detection> detections =
      DecodeAll(network_->Forward(MakeBlob(color, letterbox)), letterbox, num_classes, options_);
  detections =
      Sanitise(std::move(detections), classes_.size(), color.cols, color.rows, kMaxCandidates);
  return SuppressOverlaps(std::move(detections), options_.nms_threshold);
}

}  // namespace semslam

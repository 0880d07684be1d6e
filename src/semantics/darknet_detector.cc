// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/semantics/darknet_detector.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <utility>

#include <opencv2/dnn.hpp>

#include "semslam/base/check.h"
#include "semslam/base/error.h"

#include "semantics/darknet_config.h"
#include "semantics/dnn_backend.h"
#include "semantics/letterbox.h"

namespace semslam {
namespace {

constexpr std::size_t kMaxCandidates = 1000;  // Before suppression; a broken network has thousands.
constexpr int kFirstScore = 5;                // Columns: x, y, width, height, objectness, scores.

std::vector<char> ReadBytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<char> bytes((std::istreambuf_iterator<char>(file)), {});
  if (!file) throw InputError(path.string() + ": cannot read");
  return bytes;
}

// One row of a head's output. OpenCV gives class scores already multiplied by objectness.
Detection Decode(const float* row, int num_classes, const Letterbox& letterbox) {
  Detection detection;
  const float* scores = row + kFirstScore;
  const float* best = std::max_element(scores, scores + num_classes);
  detection.class_id = static_cast<int>(best - scores);
  detection.score = *best;
  detection.box = letterbox.ToImage(row[0], row[1], row[2], row[3]);
  detection.class_scores.assign(scores, scores + num_classes);
  return detection;
}

std::vector<Detection> DecodeAll(const std::vector<cv::Mat>& outputs,
                                 int num_classes,
                                 const Letterbox& letterbox,
                                 float score_threshold) {
  std::vector<Detection> detections;
  for (const cv::Mat& output : outputs) {
    for (int i = 0; i < output.rows; ++i) {
      const auto* row = output.ptr<float>(i);
      // No class score exceeds the objectness, so most rows end here. NaN too.
      const bool may_pass = row[4] >= score_threshold;
      if (!may_pass) continue;
      const bool passes = std::any_of(row + kFirstScore, row + kFirstScore + num_classes,
                                      [=](float score) { return score >= score_threshold; });
      if (passes) detections.push_back(Decode(row, num_classes, letterbox));
    }
  }
  return detections;
}

}  // namespace

// The network in OpenCV's hands, with the shapes that its outputs must have.
class DarknetDetector::Network {
 public:
  Network(const Options& options, std::size_t num_classes) {
    DarknetConfig config = DarknetConfig::FromFile(options.config);
    if (options.input_size > 0) config.SetInputSize(options.input_size, options.input_size);
    shape_ = AnalyseDarknet(config, num_classes);
    CheckDarknetWeights(options.weights, config, shape_.num_weights);
    width_ = config.input_width();
    height_ = config.input_height();
    // OpenCV cuts scores below `thresh` (0.2 by default), which would hide the second-best classes,
    // and would suppress overlaps regardless of classes.
    config.SetInAll("yolo", "thresh", std::to_string(options.min_class_score));
    config.SetInAll("yolo", "nms_threshold", "0");
    const std::string text = config.ToText();
    const std::vector<char> weights = ReadBytes(options.weights);
    try {
      net_ = cv::dnn::readNetFromDarknet(text.data(), text.size(), weights.data(), weights.size());
      SelectBackend(net_, options.backend, options.target);
      output_names_ = net_.getUnconnectedOutLayersNames();
      Warm(config);
    } catch (const cv::Exception& error) {
      throw InputError(config.name() + ": OpenCV cannot run the network: " + error.err);
    }
  }

  int width() const { return width_; }
  int height() const { return height_; }

  std::vector<cv::Mat> Forward(const cv::Mat& blob) {
    net_.setInput(blob);
    std::vector<cv::Mat> outputs;
    net_.forward(outputs, output_names_);
    return outputs;
  }

 private:
  // OpenCV allocates at the first run, and only then are shapes known.
  void Warm(const DarknetConfig& config) {
    const cv::Mat grey(height_, width_, CV_8UC3, cv::Scalar(128, 128, 128));
    const std::vector<cv::Mat> outputs =
        Forward(MakeBlob(grey, Letterbox::Fit(width_, height_, width_, height_)));
    std::vector<std::pair<int, int>> found;
    found.reserve(outputs.size());
    std::vector<std::pair<int, int>> expected;
    expected.reserve(shape_.heads.size());
    for (const cv::Mat& output : outputs) {
      found.emplace_back(output.dims == 2 && output.type() == CV_32FC1 ? output.rows : -1,
                         output.dims == 2 ? output.cols : -1);
    }
    for (const DarknetShape::Head& head : shape_.heads) {
      expected.emplace_back(head.rows, head.columns);
    }
    std::sort(found.begin(), found.end());
    std::sort(expected.begin(), expected.end());
    if (found != expected) {
      throw InputError(config.name() + ": the network's outputs do not have the expected shapes");
    }
  }

  DarknetShape shape_;
  cv::dnn::Net net_;
  std::vector<cv::String> output_names_;
  int width_ = 0;
  int height_ = 0;
};

DarknetDetector::DarknetDetector(const Options& options, ClassTable classes)
    : options_(options), classes_(std::move(classes)) {
  options_.Validate();
  network_ = std::make_unique<Network>(options_, classes_.size());
}

DarknetDetector::~DarknetDetector() = default;

std::vector<Detection> DarknetDetector::Detect(const RgbdImage& image) {
  const cv::Mat& color = image.color;
  SEMSLAM_CHECK(!color.empty() && color.type() == CV_8UC3) << "type " << color.type();
  const auto place = options_.letterbox ? Letterbox::Fit : Letterbox::Stretch;
  const Letterbox letterbox = place(color.cols, color.rows, network_->width(), network_->height());
  const std::vector<cv::Mat> outputs = network_->Forward(MakeBlob(color, letterbox));
  std::vector<Detection> detections =
      DecodeAll(outputs, static_cast<int>(classes_.size()), letterbox, options_.score_threshold);
  detections =
      Sanitise(std::move(detections), classes_.size(), color.cols, color.rows, kMaxCandidates);
  return SuppressOverlaps(std::move(detections), options_.nms_threshold);
}

}  // namespace semslam

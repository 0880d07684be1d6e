// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/dnn.hpp>

#include "semslam/base/error.h"

#include "semantics/dnn_backend.h"
#include "semantics/letterbox.h"
#include "semantics/network.h"
#include "semantics/onnx_input.h"

namespace semslam {
namespace {

constexpr int kUsualInputSize = 640;  // Of exported networks.
constexpr int kBoxValues = 4;         // Centre x, y, width, height.

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

// What Detector.inputSize asks for, or the file; else the usual.
cv::Size InputSize(const NetworkOptions& options) {
  if (options.input_size > 0) return {options.input_size, options.input_size};
  return ReadOnnxInputSize(options.config).value_or(cv::Size(kUsualInputSize, kUsualInputSize));
}

class OnnxNetwork : public Network {
 public:
  OnnxNetwork(const NetworkOptions& options, int num_classes)
      : options_(options), file_(options.config.string()), num_classes_(num_classes) {
    if (!std::filesystem::is_regular_file(options.config))
      throw InputError(file_ + ": cannot open the network");
    try {
      net_ = cv::dnn::readNetFromONNX(file_);
    } catch (const cv::Exception& error) {
      throw InputError(file_ + ": OpenCV cannot read the network: " + error.err);
    }
    input_size_ = InputSize(options);
    SelectBackend(net_, options.backend, options.target);
    Warm();
  }

  cv::Size input_size() const override { return input_size_; }

  std::vector<std::vector<Detection>> Run(const cv::Mat& blob,
                                          const Letterbox& letterbox) override {
    std::vector<std::vector<Detection>> detections;
    for (const Rows& rows : Forward(blob)) {
      detections.push_back(DecodeAll(rows, letterbox, num_classes_, options_));
    }
    return detections;
  }

 private:
  // OpenCV allocates at the first run, and only then are shapes known.
  void Warm() {
    const cv::Mat grey(input_size_, CV_8UC3, cv::Scalar(128, 128, 128));
    const std::vector<cv::Mat> pictures(static_cast<std::size_t>(options_.batch_size), grey);
    try {
      Forward(MakeBlob(pictures, Letterbox::Fit(grey.cols, grey.rows, grey.cols, grey.rows)));
    } catch (const cv::Exception& error) {
      throw InputError(
          file_ + ": OpenCV cannot run the network with " + std::to_string(options_.batch_size) +
          " x " + std::to_string(input_size_.width) + " x " + std::to_string(input_size_.height) +
          " pixels (Detector.batchSize, Detector.inputSize): " + error.err);
    }
  }

  // For each image. Throws InputError if the output has none of the known forms.
  std::vector<Rows> Forward(const cv::Mat& blob) {
    net_.setInput(blob);
    const cv::Mat output = net_.forward();
    std::vector<Rows> rows;
    // Of a network that was exported for one image, OpenCV gives images x 1 x ... for several.
    const bool has_one_axis_more = output.dims == 4 && output.size[1] == 1;
    if ((output.dims == 3 || has_one_axis_more) && output.size[0] == blob.size[0] &&
        output.type() == CV_32FC1) {
      for (int image = 0; image < output.size[0]; ++image) {
        const cv::Mat plane(output.size[output.dims - 2], output.size[output.dims - 1], CV_32FC1,
                            const_cast<uchar*>(output.ptr(image)));
        if (plane.cols == kBoxValues + 1 + num_classes_) {
          rows.push_back({plane.clone(), true});
        } else if (plane.rows == kBoxValues + num_classes_) {
          rows.push_back({plane.t(), false});
        }
      }
    }
    if (!rows.empty()) return rows;
    const std::string images = std::to_string(blob.size[0]);
    throw InputError(file_ + ": expected an output of " + images + " x boxes x " +
                     std::to_string(kBoxValues + 1 + num_classes_) + " or " + images + " x " +
                     std::to_string(kBoxValues + num_classes_) + " x boxes for " +
                     std::to_string(num_classes_) + " class names, found " + ShapeOf(output));
  }

  NetworkOptions options_;
  std::string file_;
  int num_classes_;
  cv::Size input_size_;
  cv::dnn::Net net_;
};

}  // namespace

std::unique_ptr<Network> LoadOnnx(const NetworkOptions& options, std::size_t num_classes) {
  return std::make_unique<OnnxNetwork>(options, static_cast<int>(num_classes));
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <string>
#include <utility>

#include <opencv2/dnn.hpp>

#include "semslam/base/error.h"

#include "semantics/darknet_config.h"
#include "semantics/dnn_backend.h"
#include "semantics/letterbox.h"
#include "semantics/network.h"

namespace semslam {
namespace {

constexpr int kFirstScore = 5;  // Columns: x, y, width, height, objectness, scores.

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

// All rows of one head for one image.
void DecodeHead(const cv::Mat& rows,
                int num_classes,
                const Letterbox& letterbox,
                float score_threshold,
                std::vector<Detection>* detections) {
  for (int i = 0; i < rows.rows; ++i) {
    const auto* row = rows.ptr<float>(i);
    // No class score exceeds the objectness, so most rows end here. NaN too.
    const bool may_pass = row[4] >= score_threshold;
    if (!may_pass) continue;
    const bool passes = std::any_of(row + kFirstScore, row + kFirstScore + num_classes,
                                    [=](float score) { return score >= score_threshold; });
    if (passes) detections->push_back(Decode(row, num_classes, letterbox));
  }
}

class DarknetNetwork : public Network {
 public:
  DarknetNetwork(const NetworkOptions& options, std::size_t num_classes)
      : num_classes_(static_cast<int>(num_classes)), score_threshold_(options.score_threshold) {
    DarknetConfig config = DarknetConfig::FromFile(options.config);
    if (options.input_size > 0) config.SetInputSize(options.input_size, options.input_size);
    shape_ = AnalyseDarknet(config, num_classes);
    CheckDarknetWeights(options.weights, config, shape_.num_weights);
    input_size_ = {config.input_width(), config.input_height()};
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
      Warm(options.batch_size, config.name());
    } catch (const cv::Exception& error) {
      throw InputError(config.name() + ": OpenCV cannot run the network: " + error.err);
    }
  }

  cv::Size input_size() const override { return input_size_; }

  std::vector<std::vector<Detection>> Run(const cv::Mat& blob,
                                          const Letterbox& letterbox) override {
    const std::vector<cv::Mat> outputs = Forward(blob);
    std::vector<std::vector<Detection>> detections(static_cast<std::size_t>(blob.size[0]));
    for (std::size_t image = 0; image < detections.size(); ++image) {
      for (const cv::Mat& output : outputs) {
        DecodeHead(RowsOf(output, static_cast<int>(image)), num_classes_, letterbox,
                   score_threshold_, &detections[image]);
      }
    }
    return detections;
  }

 private:
  std::vector<cv::Mat> Forward(const cv::Mat& blob) {
    net_.setInput(blob);
    std::vector<cv::Mat> outputs;
    net_.forward(outputs, output_names_);
    return outputs;
  }

  // Of a head: rows x columns for one image, images x rows x columns for several.
  static cv::Mat RowsOf(const cv::Mat& output, int image) {
    if (output.dims == 2) return output;
    return {output.size[1], output.size[2], CV_32FC1, const_cast<uchar*>(output.ptr(image))};
  }

  // OpenCV allocates at the first run, and only then are shapes known.
  void Warm(int batch_size, const std::string& name) {
    const cv::Mat grey(input_size_, CV_8UC3, cv::Scalar(128, 128, 128));
    const std::vector<cv::Mat> pictures(static_cast<std::size_t>(batch_size), grey);
    const std::vector<cv::Mat> outputs =
        Forward(MakeBlob(pictures, Letterbox::Fit(grey.cols, grey.rows, grey.cols, grey.rows)));
    std::vector<std::vector<int>> found;
    std::vector<std::vector<int>> expected;
    for (const cv::Mat& output : outputs) {
      if (output.type() != CV_32FC1) continue;
      found.emplace_back(output.size.p, output.size.p + output.dims);
    }
    for (const DarknetShape::Head& head : shape_.heads) {
      if (batch_size == 1) {
        expected.push_back({head.rows, head.columns});
      } else {
        expected.push_back({batch_size, head.rows, head.columns});
      }
    }
    std::sort(found.begin(), found.end());
    std::sort(expected.begin(), expected.end());
    if (found != expected) {
      throw InputError(name + ": the network's outputs do not have the expected shapes");
    }
  }

  DarknetShape shape_;
  cv::dnn::Net net_;
  std::vector<cv::String> output_names_;
  cv::Size input_size_;
  int num_classes_;
  float score_threshold_;
};

}  // namespace

std::unique_ptr<Network> LoadDarknet(const NetworkOptions& options, std::size_t num_classes) {
  return std::make_unique<DarknetNetwork>(options, num_classes);
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "semslam/semantics/detector.h"

namespace semslam {

// A network of the YOLOv3 kind (Darknet cfg and weights, [yolo] heads; Redmon and Farhadi 2018),
// run by OpenCV on the CPU. Not thread-safe.
class DarknetDetector : public Detector {
 public:
  struct Options {
    std::filesystem::path config;   // Darknet's .cfg
    std::filesystem::path weights;  // and .weights.
    int input_size = 0;             // Pixels, a multiple of 32; 0: as the cfg says.
    float score_threshold = 0.25F;  // Detections with a lower best score are left out.
    float nms_threshold = 0.45F;    // Overlap above which the weaker of one class is dropped.
    // Class scores below this are cut to 0; the rest form the detection's class distribution.
    float min_class_score = 0.02F;
    void Validate() const;  // Throws InputError.
  };

  // Reads the network and runs it once. OpenCV accepts truncated and foreign weights and wrong
  // names in silence, so everything is checked here first: throws InputError if a file cannot be
  // read, the cfg has layers this project does not know or heads that do not fit the number of
  // classes, or the weights do not have exactly the size that the cfg asks for.
  DarknetDetector(const Options& options, ClassTable classes);
  ~DarknetDetector() override;

  // The image is fitted into the network's input without distortion, with a grey border, as Darknet
  // does. Returns non-maximum suppressed detections, best first.
  std::vector<Detection> Detect(const RgbdImage& image) override;
  const ClassTable& classes() const override { return classes_; }

 private:
  class Network;  // Hides OpenCV's dnn headers.

  Options options_;
  ClassTable classes_;
  std::unique_ptr<Network> network_;
};

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "semslam/semantics/detector.h"
#include "semslam/semantics/network_options.h"

namespace semslam {

// A detector in an ONNX file, run by OpenCV: one input, 1 x 3 x size x size, RGB in [0, 1]; one
// output of float, with boxes in pixels of the input, in one of two forms:
//   1 x boxes x (5 + classes)   centre x, y, width, height, objectness, classes (YOLOv5, YOLOv7)
//   1 x (4 + classes) x boxes   centre x, y, width, height, classes (YOLOv8 and later)
// OpenCV 4.6 wants opset 12. Not thread-safe.
class OnnxDetector : public Detector {
 public:
  using Options = NetworkOptions;

  // Reads the network and runs it once. Throws InputError if the file cannot be read, OpenCV cannot
  // run it with input_size, or its output has none of the forms for the number of classes.
  OnnxDetector(const Options& options, ClassTable classes);
  ~OnnxDetector() override;

  // As DarknetDetector.
  std::vector<Detection> Detect(const RgbdImage& image) override;
  const ClassTable& classes() const override { return classes_; }

 private:
  class Network;  // Hides OpenCV's dnn headers.

  Options options_;
  ClassTable classes_;
  std::unique_ptr<Network> network_;
};

}  // namespace semslam

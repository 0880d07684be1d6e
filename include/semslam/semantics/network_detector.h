// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "semslam/semantics/detector.h"
#include "semslam/semantics/network_options.h"

namespace semslam {

class Network;  // Hides OpenCV's dnn headers.

// A network run by OpenCV, read from
// - Darknet's cfg and weights, of the YOLOv3 kind ([yolo] heads; Redmon and Farhadi 2018), or
// - an .onnx file (OpenCV 4.6 wants opset 12): one input, images x 3 x height x width, RGB in
//   [0, 1]; one output of float, with boxes in pixels of the input, in one of two forms:
//     images x boxes x (5 + classes)   centre x, y, width, height, objectness, classes (YOLOv5, v7)
//     images x (4 + classes) x boxes   centre x, y, width, height, classes (YOLOv8 and later)
// Not thread-safe.
class NetworkDetector : public Detector {
 public:
  using Options = NetworkOptions;

  // Reads the network and runs it once. OpenCV accepts truncated and foreign Darknet weights and
  // wrong names in silence, so everything is checked here first: throws InputError if a file cannot
  // be read, a cfg has layers this project does not know or heads that do not fit the number of
  // classes, weights do not have exactly the size that the cfg asks for, OpenCV cannot run the
  // network with input_size and batch_size, or its output has none of the forms above.
  NetworkDetector(const Options& options, ClassTable classes);
  ~NetworkDetector() override;
  NetworkDetector(NetworkDetector&&) noexcept;

  // The image is fitted into the network's input without distortion, with a grey border, as Darknet
  // does. Returns non-maximum suppressed detections, best first.
  std::vector<Detection> Detect(const RgbdImage& image) override;
  std::vector<std::vector<Detection>> DetectAll(std::span<const RgbdImage> images) override;
  std::size_t batch_size() const override;
  const ClassTable& classes() const override { return classes_; }

 private:
  Options options_;
  ClassTable classes_;
  std::unique_ptr<Network> network_;
};

}  // namespace semslam

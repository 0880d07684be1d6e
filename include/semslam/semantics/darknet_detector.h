// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "semslam/semantics/detector.h"
#include "semslam/semantics/network_options.h"

namespace semslam {

// A network of the YOLOv3 kind (Darknet cfg and weights, [yolo] heads; Redmon and Farhadi 2018),
// run by OpenCV. Not thread-safe.
class DarknetDetector : public Detector {
 public:
  using Options = NetworkOptions;

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

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "semslam/semantics/detection.h"
#include "semslam/semantics/network_options.h"

#include "semantics/letterbox.h"

namespace semslam {

// A network in OpenCV's hands, checked against the number of classes.
class Network {
 public:
  virtual ~Network() = default;
  virtual cv::Size input_size() const = 0;
  // For each image of the blob (images x 3 x height x width) the boxes with a score of at least
  // score_threshold, not yet suppressed, in pixels of the images that `letterbox` fitted.
  virtual std::vector<std::vector<Detection>> Run(const cv::Mat& blob,
                                                  const Letterbox& letterbox) = 0;
};

// Throw InputError.
std::unique_ptr<Network> LoadDarknet(const NetworkOptions& options, std::size_t num_classes);
std::unique_ptr<Network> LoadOnnx(const NetworkOptions& options, std::size_t num_classes);

}  // namespace semslam

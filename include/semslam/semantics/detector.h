// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "semslam/camera/rgbd_image.h"
#include "semslam/semantics/class_table.h"
#include "semslam/semantics/detection.h"

namespace semslam {

// Finds objects of known classes in colour images. A detector belongs to one thread at a time.
class Detector {
 public:
  virtual ~Detector() = default;

  // Boxes within the image, in the pixels of the image as recorded.
  virtual std::vector<Detection> Detect(const RgbdImage& image) = 0;

  // The same for several images of one size, in their order.
  virtual std::vector<std::vector<Detection>> DetectAll(std::span<const RgbdImage> images);
  // How many images to give to DetectAll at most, for speed.
  virtual std::size_t batch_size() const { return 1; }

  // The classes that the detections' ids mean.
  virtual const ClassTable& classes() const = 0;
};

}  // namespace semslam

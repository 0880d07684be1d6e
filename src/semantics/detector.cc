// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/semantics/detector.h"

namespace semslam {

std::vector<std::vector<Detection>> Detector::DetectAll(std::span<const RgbdImage> images) {
  std::vector<std::vector<Detection>> found;
  for (const RgbdImage& image : images) found.push_back(Detect(image));
  return found;
}

}  // namespace semslam

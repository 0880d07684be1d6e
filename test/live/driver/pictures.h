// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "script.h"

namespace semslam::testing {

// The images that the virtual camera shows, all in memory.
class Pictures {
 public:
  explicit Pictures(const Script& script);

  std::size_t size() const { return frames_.size(); }
  // Seconds since the first one.
  double Time(std::size_t frame) const { return frames_[frame].time; }
  const cv::Mat& Color(std::size_t frame) const;  // CV_8UC3, RGB.
  const cv::Mat& Depth(std::size_t frame) const;  // CV_16UC1, millimetres.

 private:
  struct Frame {
    double time = 0;
    std::string color;  // Names of images.
    std::string depth;
  };

  void ReadClip(const Script& script);
  void DrawPattern(const Script& script);

  std::vector<Frame> frames_;
  std::map<std::string, cv::Mat> images_;  // A clip may show one several times.
};

}  // namespace semslam::testing

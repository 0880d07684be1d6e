// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "semslam/base/time.h"
#include "semslam/semantics/detector.h"

namespace semslam {

// Detections that another program wrote: a file an image, whose name is the colour image's time in
// seconds, as in TUM sequences. An image without a file has no detections. Either in YOLO's format
// (1305031102.175304.txt), a line
//   class cx cy width height [score]
// for every object, the class as a number from 0, the rest relative to the image's size in [0, 1];
// or as JSON (1305031102.175304.json), a list of
//   {"name": "cup", "confidence": 0.9, "box": {"x1": 10, "y1": 20, "x2": 50, "y2": 70}}
// with the box in pixels, which may also be [x1, y1, x2, y2]; "class": number may stand instead of
// the name, and "score" instead of "confidence". A missing score means 1.
class RecordedDetector : public Detector {
 public:
  struct Options {
    std::filesystem::path folder;
    double max_time_difference = 0.005;  // Seconds between image and file name.
    float score_threshold = 0.0F;        // Lower scores are left out.
  };

  // Reads all files; throws InputError with file and line for anything that is not as described.
  RecordedDetector(const Options& options, ClassTable classes);

  std::vector<Detection> Detect(const RgbdImage& image) override;
  const ClassTable& classes() const override { return classes_; }
  std::size_t num_images() const { return images_.size(); }

 private:
  struct Image {
    TimeNs time;
    std::vector<Detection> detections;
    bool is_relative;  // Boxes are relative to the image's size, else in pixels.
  };
  Options options_;
  ClassTable classes_;
  std::vector<Image> images_;  // By time.
};

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "semslam/semantics/detector.h"

namespace semslam {

// A detector that also writes down what it finds, in a folder that RecordedDetector reads: for each
// image TIME.txt (lines `class cx cy width height score`, relative to the image's size) and
// TIME.jpg, the image with the boxes; and classes.names. One thread at a time.
class DetectionRecorder : public Detector {
 public:
  // Makes the folder, and clears it of the files of an earlier recording. Throws InputError if that
  // cannot be done.
  DetectionRecorder(std::unique_ptr<Detector> detector, std::filesystem::path folder);

  // Throws InputError if a file cannot be written, and what the detector throws.
  std::vector<Detection> Detect(const RgbdImage& image) override;
  const ClassTable& classes() const override { return detector_->classes(); }

 private:
  std::unique_ptr<Detector> detector_;
  std::filesystem::path folder_;
};

// Boxes in the colours of their classes, each with name and score, on a copy of a colour or grey
// image.
cv::Mat DrawDetections(const cv::Mat& image,
                       const std::vector<Detection>& detections,
                       const ClassTable& classes);

}  // namespace semslam

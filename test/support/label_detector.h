// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "semslam/render/clip_writer.h"
#include "semslam/semantics/detector.h"

namespace semslam::testing {

// A rendered clip kept in memory: its images, and what a good detector would say of them. A test
// that uses it links semslam::render and semslam::semantics.
class RecordedClip {
 public:
  explicit RecordedClip(const RenderedClip::Options& options) : clip_(options) {
    const DetectionOptions detection_options;
    for (std::size_t i = 0; i < clip_.num_frames(); ++i) {
      RenderedFrame frame = clip_.Frame(i);
      images_.push_back(std::make_shared<const RgbdImage>(RgbdImage{
          frame.time, frame.color, DepthToMetres(frame.depth_16u, options.depth_factor)}));
      std::vector<Detection>& found = detections_[frame.time];
      for (const TrueDetection& truth : DetectFromLabels(frame.ideal.labels, clip_.instances(),
                                                         options.seed, i, detection_options)) {
        Detection detection;
        detection.class_id = truth.class_index;
        detection.score = static_cast<float>(truth.score);
        detection.box = {static_cast<float>(truth.box.x), static_cast<float>(truth.box.y),
                         static_cast<float>(truth.box.br().x),
                         static_cast<float>(truth.box.br().y)};
        detection.class_scores.resize(detection_options.class_names.size());
        detection.class_scores[truth.class_index] = detection.score;
        found.push_back(detection);
      }
    }
  }

  const RenderedClip& clip() const { return clip_; }
  const std::vector<RgbdImagePtr>& images() const { return images_; }

  // Looks images up by their time.
  std::unique_ptr<Detector> MakeDetector() const {
    return std::make_unique<LabelDetector>(detections_);
  }

 private:
  class LabelDetector : public Detector {
   public:
    explicit LabelDetector(std::map<TimeNs, std::vector<Detection>> detections)
        : detections_(std::move(detections)), classes_(DetectionOptions().class_names) {}
    std::vector<Detection> Detect(const RgbdImage& image) override {
      return detections_.at(image.time);
    }
    const ClassTable& classes() const override { return classes_; }

   private:
    std::map<TimeNs, std::vector<Detection>> detections_;
    ClassTable classes_;
  };

  RenderedClip clip_;
  std::vector<RgbdImagePtr> images_;
  std::map<TimeNs, std::vector<Detection>> detections_;
};

}  // namespace semslam::testing

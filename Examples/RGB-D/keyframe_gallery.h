// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "semslam/base/guarded.h"
#include "semslam/base/time.h"
#include "semslam/camera/rgbd_image.h"
#include "semslam/semantics/detection.h"
#include "semslam/semantics/detector.h"

// Keeps pictures of keyframes, and what was detected in them, for the report. Of a long run it
// keeps every second, fourth ... keyframe, so that memory has a bound. For any number of threads.
class KeyframeGallery {
 public:
  struct Picture {
    std::string jpeg;
    std::vector<semslam::Detection> detections;
  };

  void Add(const semslam::RgbdImage& keyframe);
  // Before or after the picture.
  void AddDetections(semslam::TimeNs time, std::vector<semslam::Detection> detections);

  // By the keyframes' times.
  std::map<semslam::TimeNs, Picture> Copy() const;

 private:
  struct Content {
    std::map<semslam::TimeNs, std::string> jpegs;
    std::map<semslam::TimeNs, std::vector<semslam::Detection>> detections;
    std::size_t step = 1;       // Every so many keyframes are kept.
    std::size_t num_added = 0;  // Keyframes, kept or not.
  };
  semslam::Guarded<Content> content_;
};

// A detector that also shows the gallery what it finds. Null for none.
std::unique_ptr<semslam::Detector> Watch(std::unique_ptr<semslam::Detector> detector,
                                         std::shared_ptr<KeyframeGallery> gallery);

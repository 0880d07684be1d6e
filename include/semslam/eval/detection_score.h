// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "semslam/eval/true_boxes.h"
#include "semslam/semantics/detection.h"

namespace semslam {

// A picture, what it shows and what a detector found in it.
struct ScoredPicture {
  std::vector<TrueBox> truth;
  std::vector<Detection> found;
};

struct DetectionScore {
  struct OfClass {
    std::size_t num_true = 0;   // Objects that are not hard.
    std::size_t num_found = 0;  // Detections, without those of hard objects.
    std::size_t num_right = 0;
    // Area under the curve of precision over recall, precision made falling (as PASCAL VOC does
    // since 2010). Not a number without true objects.
    double average_precision = 0;
  };
  std::vector<OfClass> classes;         // By class id.
  double MeanAveragePrecision() const;  // Over the classes that have true objects.
};

// In each picture and class, best score first, a detection is right if its box overlaps by at least
// `min_overlap` (intersection over union) a true one that no better detection has taken: the one of
// greatest overlap. One that overlaps only hard ones is left out. AP50 is min_overlap = 0.5.
// Equal scores: earlier pictures and detections first.
DetectionScore ScoreDetections(std::span<const ScoredPicture> pictures,
                               std::size_t num_classes,
                               float min_overlap = 0.5F);

}  // namespace semslam

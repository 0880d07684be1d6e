// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "semslam/semantics/class_table.h"

namespace semslam {

// A rectangle in the recorded image, in pixels. The pixel in column c covers [c, c + 1).
struct ImageBox {
  float min_x = 0;
  float min_y = 0;
  float max_x = 0;
  float max_y = 0;

  float width() const { return max_x - min_x; }
  float height() const { return max_y - min_y; }
  float Area() const;
  // Of the centre of a pixel.
  bool ContainsPixel(int column, int row) const;
  ImageBox ClippedTo(int image_width, int image_height) const;
};

// In [0, 1].
float IntersectionOverUnion(const ImageBox& a, const ImageBox& b);

// Something that a detector saw in one image.
struct Detection {
  int class_id = kNoClass;  // The class of the highest score.
  float score = 0;          // Of that class, in [0, 1].
  ImageBox box;             // Within the image.
  // Score of every class, in [0, 1] each: networks waver between similar classes (monitor, laptop)
  // from frame to frame, and only the average over views tells.
  std::vector<float> class_scores;
};

// Keeps detections in the order of falling score, and drops one that overlaps a kept one of the
// same class by more than `max_overlap` (intersection over union).
std::vector<Detection> SuppressOverlaps(std::vector<Detection> detections, float max_overlap);

// Makes whatever a detector gave safe to use: drops detections with scores that are not finite or
// not above 0, with unknown classes, another number of class scores than num_classes, or less than
// a pixel within the image; clips boxes and scores; keeps the best max_detections.
std::vector<Detection> Sanitise(std::vector<Detection> detections,
                                std::size_t num_classes,
                                int image_width,
                                int image_height,
                                std::size_t max_detections = 200);

}  // namespace semslam

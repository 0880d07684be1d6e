// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "semslam/geometry/oriented_box.h"

namespace semslam {

// A thing with a class (from 1) and a place, true or found.
struct ScoredObject {
  std::uint32_t id = 0;
  std::uint32_t class_number = 0;
  OrientedBox box;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  // False for a true one that is too little seen: it need not be found, and is no mistake if it is.
  bool counts = true;
};

struct ObjectMatch {
  std::size_t true_index = 0;
  std::size_t found_index = 0;
  double overlap = 0;  // Intersection over union of the boxes.
  bool has_right_class = false;
  double centroid_error = 0;  // Metres.
};

// Shares whose denominator is 0 are not a number.
struct ObjectScore {
  double min_overlap = 0;
  std::size_t num_true = 0;          // That count.
  std::size_t num_found = 0;         // Without those matched with a true one that does not count.
  std::vector<ObjectMatch> matches;  // With a true one that counts; by true_index.

  std::size_t NumRight() const;  // Matches of the right class.
  double Precision() const;      // NumRight over num_found.
  double Recall() const;         // NumRight over num_true.
  double ClassAccuracy() const;  // NumRight over matches.
  double MedianCentroidError() const;
};

// Matches objects one to one whose boxes overlap by at least `min_overlap`: those of equal class
// first, then the greatest overlap first (equal ones by index).
ObjectScore ScoreObjects(std::span<const ScoredObject> truth,
                         std::span<const ScoredObject> found,
                         double min_overlap);

}  // namespace semslam

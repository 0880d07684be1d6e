// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <vector>

#include "semslam/base/id.h"
#include "semslam/map/map.h"

namespace semslam {

struct SimilarPlaceOptions {
  double min_shared_words = 0.8;          // Of the most that any keyframe shares with the image.
  double min_group_score = 0.75;          // Of the best group's.
  std::size_t num_neighbours = 10;        // Covisible keyframes that make a group with a keyframe.
  float min_score = 0;                    // Of a keyframe by itself.
  std::vector<KeyframeId> excluded = {};  // Ascending; as if they were not in the map.
};

// The keyframes that look like an image, likeliest first. Keyframes of one place are similar to the
// image together, so each counts with those of its neighbours that are similar too, and the best of
// each such group is returned (Mur-Artal, Montiel, Tardos 2015, section III-E; Galvez-Lopez and
// Tardos 2012, section V-B).
std::vector<KeyframeId> FindSimilarPlaces(const Map& map,
                                          const BowVector& bow,
                                          const SimilarPlaceOptions& options);

}  // namespace semslam

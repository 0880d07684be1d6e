// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <span>
#include <vector>

#include "semslam/map/landmark_projection.h"
#include "semslam/map/map.h"

namespace semslam {

// A landmark that a keyframe's feature seems to show.
struct LandmarkHit {
  LandmarkId landmark;
  int feature = 0;
};

struct LandmarkSearchOptions {
  float radius = 3.0F;          // Pixels of the level where the landmark is expected.
  bool must_agree_well = true;  // Within the noise of a feature; else anywhere in the window.
};

// Searches landmarks in a keyframe at its pose. Those that it sees already are passed over.
std::vector<LandmarkHit> FindLandmarks(const ProjectionCamera& camera,
                                       const KeyframeCopy& keyframe,
                                       std::span<const LandmarkCopy> landmarks,
                                       const LandmarkSearchOptions& options);

// A hit on a free feature becomes an observation; a hit on another landmark merges the two into the
// one that is known from more views. What is gone meanwhile is skipped. Returns how many hits
// counted.
int FuseHits(KeyframeId keyframe, std::span<const LandmarkHit> hits, Map& map);

}  // namespace semslam

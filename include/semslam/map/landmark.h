// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include <Eigen/Core>

#include "semslam/base/id.h"
#include "semslam/features/descriptor.h"

namespace semslam {

// That a keyframe's feature shows a landmark.
struct Observation {
  KeyframeId keyframe;
  int feature = 0;  // Index into the keyframe's features.
};

// What is needed to search a landmark in an image. Copied out of the map by those who search.
struct LandmarkAppearance {
  Eigen::Vector3d p_world = Eigen::Vector3d::Zero();
  Eigen::Vector3f view_direction =
      Eigen::Vector3f::Zero();  // Unit, mean direction from the cameras to it.
  float min_distance =
      0;  // Metres; nearer or farther it falls off the image pyramid of its reference view.
  float max_distance = 0;
  Descriptor descriptor;  // The observed one that is nearest to all others.
};

// A landmark as it is copied out of the map.
struct LandmarkCopy {
  LandmarkId id;
  LandmarkAppearance appearance;
};

struct Landmark {
  LandmarkId id;
  LandmarkAppearance appearance;
  KeyframeId reference_keyframe;  // Whose view defines the distance range: the oldest observer.
  KeyframeId first_keyframe;      // That made it.
  std::vector<Observation> observations;  // Sorted by keyframe, one a keyframe.
  int num_measurements = 0;  // Observations, those with depth counted twice, like a stereo pair.
  int num_visible = 1;       // Frames in whose view it should have been.
  int num_found = 1;         // Frames in which it was tracked.
};

}  // namespace semslam

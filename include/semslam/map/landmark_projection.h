// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>

#include "semslam/camera/pinhole_camera.h"
#include "semslam/features/projection_matcher.h"
#include "semslam/geometry/rigid3.h"
#include "semslam/map/landmark.h"
#include "semslam/map/map.h"

namespace semslam {

// A camera whose depth is treated as a second, virtual camera to the right of it.
struct ProjectionCamera {
  const PinholeCamera& camera;
  double baseline_times_fx;  // px m.
  ScaleSpace scale_space;
};

// Where and at which pyramid level a camera should see a landmark.
struct LandmarkProjection {
  ProjectedPoint
      point;  // Its radius is one pixel of the expected level; octaves: that level and one finer.
  float view_cosine = 1;  // Between this and the usual viewing direction.
};

// Nothing unless the landmark is in front of the camera and inside the image, seen from within 60
// degrees of the usual direction and from a distance at which the image pyramid still holds it (0.8
// to 1.2 times its range).
std::optional<LandmarkProjection> ProjectLandmark(const ProjectionCamera& camera,
                                                  const Rigid3& T_world_camera,
                                                  const LandmarkAppearance& landmark);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "semslam/camera/pinhole_camera.h"
#include "semslam/io/objects_io.h"
#include "semslam/io/report.h"
#include "semslam/semantics/detection.h"

namespace semslam {

// Where an object is seen.
struct ObjectView {
  std::size_t keyframe = 0;  // Place among the keyframes.
  ImageBox box;              // Of the object in the recorded image.
};

// The keyframes with a picture that show the object best, best first: those in which it was
// detected, then those in whose picture it lies whole and largest.
std::vector<ObjectView> FindObjectViews(const ObjectRecord& object,
                                        const std::vector<ReportKeyframe>& keyframes,
                                        const PinholeCamera& camera,
                                        std::size_t max_views);

}  // namespace semslam

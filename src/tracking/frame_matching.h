// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "semslam/features/projection_matcher.h"
#include "semslam/map/landmark_projection.h"
#include "semslam/optim/camera_model.h"
#include "semslam/tracking/local_map.h"
#include "semslam/tracking/tracked_frame.h"

namespace semslam {

// The last frame's points, searched within `radius_px` (at the finest level) of where `predicted`
// shows them. Returns `predicted` with the points assigned.
TrackedFrame MatchLastFrame(const TrackedFrame& last,
                            const TrackedFrame& predicted,
                            const ProjectionCamera& camera,
                            float radius_px);

// A landmark of the local map that should be in view.
struct VisibleLandmark {
  std::size_t entry = 0;  // Index into the local map.
  ProjectedPoint projection;
};
// Those of the local map that the frame should show. The search window is `radius_factor` times 2.5
// pixels of the expected level where the landmark is seen as usual, times 4 where more from the
// side.
std::vector<VisibleLandmark> FindVisible(const std::vector<LocalMap::Entry>& local_map,
                                         const TrackedFrame& frame,
                                         const ProjectionCamera& camera,
                                         float radius_factor);

// Optimises the frame's pose on its points and drops those that do not agree. Returns how many are
// left.
int OptimizeAndDropOutliers(const StereoCamera& stereo,
                            const ScaleSpace& scale_space,
                            TrackedFrame* frame);

}  // namespace semslam

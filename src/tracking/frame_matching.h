// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "semslam/features/projection_matcher.h"
#include "semslam/map/landmark_projection.h"
#include "semslam/map/map.h"
#include "semslam/optim/camera_model.h"
#include "semslam/place/vocabulary.h"
#include "semslam/tracking/tracked_frame.h"

namespace semslam {

// A keyframe copied out of the map, to be recognised in a frame.
struct KnownKeyframe {
  std::shared_ptr<const Frame> frame;
  std::shared_ptr<const BagOfWords> words;          // Null: not looked up yet.
  std::vector<std::optional<TrackedPoint>> points;  // One a feature.
};
KnownKeyframe CopyKnownKeyframe(const Map& map, const Keyframe& keyframe);

// Pairs of the keyframe's features that have a point (query) and of the frame's that show the same
// words. `words` are those of the frame.
std::vector<FeatureMatch> MatchKnownKeyframe(const KnownKeyframe& keyframe,
                                             const Frame& frame,
                                             const BagOfWords& words,
                                             const Vocabulary& vocabulary);

// A frame at the given pose that shows nothing yet.
TrackedFrame EmptyFrame(std::shared_ptr<const Frame> frame, const Rigid3& T_world_camera);

// The last frame's points, searched within `radius_px` (at the finest level) of where `predicted`
// shows them. Returns `predicted` with the points assigned.
TrackedFrame MatchLastFrame(const TrackedFrame& last,
                            const TrackedFrame& predicted,
                            const ProjectionCamera& camera,
                            float radius_px);

// Searches those landmarks in the frame that it should show at its pose and that none of its points
// is, and assigns the features that show them. The search window is `radius_factor` times 2.5
// pixels of the expected level where the landmark is seen as usual, times 4 where more from the
// side. Returns the landmarks that were searched.
std::vector<LandmarkId> SearchLandmarks(const std::vector<LandmarkCopy>& landmarks,
                                        const ProjectionCamera& camera,
                                        float radius_factor,
                                        TrackedFrame* frame);

// Optimises the frame's pose on its points and drops those that do not agree. Returns how many are
// left.
int OptimizeAndDropOutliers(const StereoCamera& stereo,
                            const ScaleSpace& scale_space,
                            TrackedFrame* frame);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <optional>
#include <span>

#include "semslam/camera/pinhole_camera.h"
#include "semslam/features/projection_matcher.h"
#include "semslam/geometry/rigid_ransac.h"
#include "semslam/map/map.h"
#include "semslam/optim/camera_model.h"
#include "semslam/place/vocabulary.h"
#include "semslam/tracking/tracked_frame.h"

namespace semslam {

struct KnownKeyframe;

// Finds a frame's pose at a place of the map without knowing where it came from: for a camera that
// was lost, and to verify loops (Mur-Artal, Montiel, Tardos 2015, sections V-C and VII-B). Where
// they solve for the pose from pixels (PnP), here the frame's own depth gives both sides in three
// dimensions: three pairs make a hypothesis without ambiguity; pixels alone serve where too little
// depth is seen. Holds no state; locks the map for
// two short copies.
class FrameLocator {
 public:
  struct Options {
    int min_word_matches = 15;  // With the place's keyframe.
    int min_pose_inliers = 10;  // Of these, after optimising.
    int min_inliers = 50;       // After the guided search: fewer are a failure.
    // Of the landmarks that the pose lets the frame show, those that it shows. A wrong place may
    // look right in one corner: the second of two equal cushions, on a wall of bricks, gives 60
    // inliers of 647 (0.09) for a pose 0.95 m off; true places give 0.21 and more.
    double min_found_share = 0.15;
    std::size_t num_neighbours = 10;  // Covisible keyframes whose landmarks are searched too.
    RansacOptions ransac{.min_inliers = 10};
    void Validate() const;  // Throws std::logic_error.
  };

  FrameLocator(const Options& options,
               const PinholeCamera& camera,
               double baseline_times_fx,
               std::shared_ptr<const Vocabulary> vocabulary,
               const SharedMap& map);

  // The frame's pose and the landmarks it shows, at the place of a keyframe. Nothing if it does not
  // show that place, or the keyframe is gone. `words` are those of the frame.
  std::optional<TrackedFrame> Locate(const std::shared_ptr<const Frame>& frame,
                                     const BagOfWords& words,
                                     KeyframeId place) const;

 private:
  std::optional<TrackedFrame> MatchPlace(const std::shared_ptr<const Frame>& frame,
                                         const BagOfWords& words,
                                         const KnownKeyframe& place) const;
  std::optional<TrackedFrame> FromDepth(const std::shared_ptr<const Frame>& frame,
                                        std::span<const FeatureMatch> matches,
                                        const KnownKeyframe& place) const;
  std::optional<TrackedFrame> FromPixels(const std::shared_ptr<const Frame>& frame,
                                         std::span<const FeatureMatch> matches,
                                         const KnownKeyframe& place) const;
  struct Support {
    int num_inliers = 0;  // Landmarks that agree with the pose,
    int num_visible = 0;  // of so many that should be seen.
  };
  Support SearchNeighbourhood(KeyframeId place, TrackedFrame* located) const;

  const Options options_;
  const PinholeCamera camera_;
  const StereoCamera stereo_;
  const std::shared_ptr<const Vocabulary> vocabulary_;
  const SharedMap& map_;
  const ScaleSpace scale_space_;
};

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

namespace semslam {

// What local mapping is doing when a frame has been tracked.
struct MapperLoad {
  bool is_idle = true;
  int num_queued = 0;  // Keyframes waiting.
};

// Decides whether a tracked frame becomes a keyframe (slam.md step 5; Mur-Artal and Tardos 2017,
// section III-E).
class KeyframePolicy {
 public:
  struct Options {
    int max_frames_between =
        30;  // Frames: the frame rate, a keyframe a second at least while things change.
    int max_queued = 3;           // Keyframes waiting for local mapping; none is added to so many.
    double weak_ratio = 0.25;     // Of the reference's landmarks: fewer are weak tracking.
    double changed_ratio = 0.75;  // Of the reference's landmarks: fewer mean the view has changed.
    double changed_ratio_at_start = 0.4;  // The same while there is one keyframe only.
    // Share of the picture that the reference does not show: more is a change too, however well the
    // landmarks are tracked. Of a walk through a room (13.8 m, a turn of 360 degrees) 0.2 instead
    // of none leaves a third of the drift and of the holes in the dense map.
    double max_new_share = 0.2;
    int min_inliers = 15;            // No keyframe from a frame with fewer.
    int enough_close_tracked = 100;  // Close points with a landmark.
    int many_close_untracked = 70;   // Close points that could become landmarks.
    void Validate() const;           // Throws std::logic_error.
  };

  struct Situation {
    int num_frames_since_keyframe = 0;
    int num_inliers = 0;
    int num_reference_landmarks = 0;  // Of the reference keyframe, those seen often enough.
    int num_keyframes = 0;
    int num_close_tracked = 0;
    int num_close_untracked = 0;
    double new_share = 0;  // Of the picture, against the reference keyframe's; about.
    MapperLoad mapper;
  };

  explicit KeyframePolicy(const Options& options);
  bool WantsKeyframe(const Situation& situation) const;

 private:
  Options options_;
};

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "semslam/camera/pinhole_camera.h"
#include "semslam/map/map.h"
#include "semslam/optim/camera_model.h"
#include "semslam/place/vocabulary.h"
#include "semslam/tracking/frame_locator.h"
#include "semslam/tracking/keyframe_policy.h"
#include "semslam/tracking/local_map.h"
#include "semslam/tracking/rolling_shutter.h"
#include "semslam/tracking/tracked_frame.h"

namespace semslam {

enum class TrackingState {
  kNotInitialized,  // No frame with enough features yet.
  kTracking,
  kLost,
};

// Finds the pose of each frame in the map and decides which frames become keyframes (Mur-Artal,
// Montiel, Tardos, "ORB-SLAM", 2015, section V; RGB-D case: Mur-Artal, Tardos, "ORB-SLAM2", 2017).
// One thread at a time; the map is shared with local mapping, and locked only for short copies and
// to insert a keyframe.
class Tracking {
 public:
  struct Options {
    int min_features_to_start = 500;  // The first frame needs more.
    double close_depth_m =
        3.1;  // Depth is trusted like a stereo baseline of ThDepth: closer points are "close".
    int min_close_points = 100;  // New landmarks: all close points, or this many of the closest.
    float search_radius_px =
        15.0F;  // Around the prediction from the last frame, at the finest level.
    int min_motion_matches =
        20;  // Fewer: search twice as wide, then fall back on the reference keyframe.
    int min_reference_matches = 15;    // With the reference keyframe, by visual words.
    int min_pose_inliers = 10;         // After optimising with either.
    int min_inliers = 30;              // In the local map; fewer: lost.
    int min_inliers_after_loss = 50;   // To be found again, and for the first second afterwards.
    std::size_t max_places_tried = 6;  // In each lost frame; bounds its time.
    // Lost in so many frames in a row that show enough to start from: a new piece of the map is
    // begun, which loop closing joins to the others once the camera sees both.
    int max_frames_lost = 5;
    // Lost with no more keyframes than these in the piece, for as many frames as were tracked: it
    // is dropped.
    std::size_t min_keyframes_to_keep = 5;
    bool localization_only = false;  // In a loaded map, which stays as it is.
    KeyframePolicy::Options keyframes;
    RollingShutter::Options shutter;
    void Validate() const;  // Throws std::logic_error.
  };

  struct Result {
    TrackingState state = TrackingState::kNotInitialized;
    Rigid3 T_world_camera;          // Meaningful only if kTracking, like all below.
    KeyframeId reference_keyframe;  // The pose is kept relative to it, so that it follows the map.
    Rigid3 T_reference_camera;
    int num_inliers = 0;  // Landmarks that agree with the pose.
    std::optional<KeyframeId>
        new_keyframe;                // Inserted into the map with this frame; local mapping is due.
    bool relocalized = false;        // The place was found again with this frame, after a loss.
    bool map_was_reset = false;      // Everything before this frame is void.
    bool piece_was_started = false;  // With this frame, for want of a known place. Its poses are in
                                     // a frame of their own until it is joined.
    bool was_skipped = false;        // Not newer than the frame before: nothing was done with it.
    std::shared_ptr<const Frame> frame;  // What was seen; null if it was skipped.
    std::vector<bool> shows_landmark;    // One a feature of `frame` while tracking, else empty.
    double first_pose_seconds = 0;       // Spent on a pose from the last frame or a keyframe,
    double local_map_seconds = 0;        // on the local map,
    double keyframe_seconds = 0;         // and on what follows.
  };

  Tracking(const Options& options,
           const PinholeCamera& camera,
           double baseline_times_fx,
           std::shared_ptr<const Vocabulary> vocabulary,
           SharedMap& map);

  // `frame` must be newer than the one before. An image without features is a normal case: it is
  // lost.
  Result Track(std::shared_ptr<const Frame> frame, const MapperLoad& mapper);

  // The map was filled from elsewhere: the first frame is looked for in it, and it is never given
  // up. Before the first frame; without keyframes in the map nothing changes.
  void StartInLoadedMap();

  // Forgets all: the map is cleared, and the next frame may be the first.
  void StartOver();
  // From the next frame on: only find the camera, and leave the map as it is; or map again.
  void SetLocalizationOnly(bool localization_only) { localization_only_ = localization_only; }

  TrackingState state() const { return state_; }
  // Of the camera's rows; see RollingShutter.
  double readout_seconds() const { return shutter_.readout_seconds(); }

 private:
  // A frame that was found in the map.
  struct Located {
    TrackedFrame frame;
    int num_inliers = 0;
    bool relocalized = false;
  };

  Result Initialize(std::shared_ptr<const Frame> frame);
  bool CanStartFrom(const Frame& frame) const;
  Result StartPiece(std::shared_ptr<const Frame> frame, const Rigid3& T_world_camera);
  Result WithSight(Result result, std::shared_ptr<const Frame> frame) const;
  Result TrackInMap(std::shared_ptr<const Frame> frame, const MapperLoad& mapper);
  void BringLastFrameUpToDate(const Map& map);
  bool MapHasMoved(bool is_located) const;
  std::optional<Located> Locate(const std::shared_ptr<const Frame>& recorded);
  std::optional<TrackedFrame> TrackFromLast(const std::shared_ptr<const Frame>& recorded);
  std::optional<Vector6d> VelocityAt(const TrackedFrame& current) const;
  std::optional<TrackedFrame> PredictAndMatch(const std::shared_ptr<const Frame>& frame);
  std::optional<TrackedFrame> TrackWithMotion(const std::shared_ptr<const Frame>& frame) const;
  KnownKeyframe LastFrameAsKeyframe() const;
  std::optional<TrackedFrame> TrackKeyframe(const std::shared_ptr<const Frame>& frame,
                                            KeyframeId keyframe) const;
  std::optional<TrackedFrame> Relocalize(const std::shared_ptr<const Frame>& frame) const;
  int TrackLocalMap(TrackedFrame* current);
  Result Succeed(Located located, const MapperLoad& mapper);
  Result Fail(std::shared_ptr<const Frame> frame);
  Result DropPiece(std::shared_ptr<const Frame> frame);
  bool IsWorthKeeping() const;
  std::optional<KeyframeId> InsertKeyframeIfWanted(Located* located, const MapperLoad& mapper);
  std::optional<KeyframePolicy::Situation> Assess(const Located& located,
                                                  const MapperLoad& mapper) const;
  KeyframeId InsertKeyframe(Map& map, TrackedFrame* current);
  Rigid3 PoseOfReference(TrackedFrame* current) const;
  void FollowCorrection(const Map& map, TrackedFrame* current) const;
  void ApplySightings(Map& map);

  const Options options_;
  const PinholeCamera camera_;
  const StereoCamera stereo_;
  const std::shared_ptr<const Vocabulary> vocabulary_;
  SharedMap& map_;
  const ScaleSpace scale_space_;
  const FrameLocator locator_;

  TrackingState state_ = TrackingState::kNotInitialized;
  bool localization_only_ = false;
  std::optional<KeyframeId> newest_loaded_;  // Of a map that was filled from elsewhere.
  KeyframePolicy keyframe_policy_;
  LocalMap local_map_;
  RollingShutter shutter_;
  std::uint64_t epoch_ = 0;    // Of the map in which the poses below are.
  TrackedFrame last_;          // The last frame that was tracked.
  KeyframeId last_reference_;  // last_ relative to this keyframe, see T_reference_last_.
  Rigid3 T_reference_last_;
  std::optional<Rigid3> T_last_next_;  // Motion of the last step; none after a loss.
  std::optional<Vector6d> velocity_;   // In that step, a second; see RollingShutter.
  int num_frames_since_found_ = 0;     // After a loss; large before the first.
  int num_frames_since_keyframe_ = 0;
  int num_frames_tracked_ = 0;     // Since the map, or the newest piece of it, was started.
  int num_frames_lost_ = 0;        // In a row.
  int num_good_frames_lost_ = 0;   // Of them, in a row: those that show enough to start from.
  double first_pose_seconds_ = 0;  // Spent on the frame in hand.
  double local_map_seconds_ = 0;

  struct Sightings {
    int num_visible = 0;
    int num_found = 0;
  };
  std::unordered_map<LandmarkId, Sightings> sightings_;  // Not yet told to the map.
};

}  // namespace semslam

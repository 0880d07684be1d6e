// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// What Tracking does once a frame's pose is known, or is not to be had.
#include <algorithm>
#include <cmath>
#include <utility>

#include "semslam/tracking/tracking.h"

#include "tracking/map_wait.h"
#include "tracking/new_points.h"

namespace semslam {
namespace {

// The share of the picture that a camera loses from sight by turning and by moving aside, if what
// it sees is `distance` away.
double NewShare(const PinholeCamera& camera,
                const Rigid3& T_world_before,
                const Rigid3& T_world_now,
                double distance) {
  constexpr double kMaxAngle = 1.5;  // Radians: there is nothing in common long before.
  const double angle = std::min(RotationAngle(T_world_before, T_world_now), kMaxAngle);
  const double shift = (T_world_now.translation - T_world_before.translation).norm();
  return (std::tan(angle) + shift / distance) * camera.fx() / camera.width();
}

}  // namespace

Tracking::Result Tracking::Succeed(Located located, const MapperLoad& mapper) {
  TrackedFrame& current = located.frame;
  if (located.relocalized) {
    num_frames_since_found_ = 0;
    T_last_next_.reset();
    velocity_.reset();
  } else {
    ++num_frames_since_found_;
    T_last_next_ = last_.T_world_camera.Inverse() * current.T_world_camera;
    velocity_ = VelocityAt(current);
  }
  state_ = TrackingState::kTracking;
  num_frames_lost_ = num_good_frames_lost_ = 0;
  ++num_frames_tracked_;
  ++num_frames_since_keyframe_;

  Result result;
  last_reference_ = local_map_.reference_keyframe();
  if (localization_only_) sightings_.clear();
  result.new_keyframe = InsertKeyframeIfWanted(&located, mapper);
  if (result.new_keyframe) {
    last_reference_ = *result.new_keyframe;
    T_reference_last_ = Rigid3();
    num_frames_since_keyframe_ = 0;
  } else {
    const Rigid3 T_world_reference = PoseOfReference(&current);
    T_reference_last_ = T_world_reference.Inverse() * current.T_world_camera;
  }
  last_ = std::move(current);

  result.state = state_;
  result.T_world_camera = last_.T_world_camera;
  result.reference_keyframe = last_reference_;
  result.T_reference_camera = T_reference_last_;
  result.num_inliers = located.num_inliers;
  result.relocalized = located.relocalized;
  return result;
}

// Of last_reference_. If the map was corrected since the frame was found in it, the frame moves
// with it; if the map cannot be had, both are left as they were when the local map was copied.
Rigid3 Tracking::PoseOfReference(TrackedFrame* current) const {
  const auto now = map_.TryRead(kMaxMapWait, [&](const Map& map) {
    FollowCorrection(map, current);
    return map.ResolvePose(last_reference_).value_or(Rigid3());
  });
  return now.value_or(local_map_.T_world_reference());
}

// If the map was corrected since the frame was found in it, the frame keeps its place beside its
// reference keyframe.
void Tracking::FollowCorrection(const Map& map, TrackedFrame* current) const {
  if (map.epoch() == epoch_) return;
  const std::optional<Rigid3> T_world_reference = map.ResolvePose(local_map_.reference_keyframe());
  if (!T_world_reference) return;
  current->T_world_camera =
      *T_world_reference * local_map_.T_world_reference().Inverse() * current->T_world_camera;
}

// Nothing if it is not wanted, or not now, because the map cannot be had: then with the next frame.
std::optional<KeyframeId> Tracking::InsertKeyframeIfWanted(Located* located,
                                                           const MapperLoad& mapper) {
  if (localization_only_) return std::nullopt;
  const std::optional<KeyframePolicy::Situation> situation = Assess(*located, mapper);
  if (!situation || !keyframe_policy_.WantsKeyframe(*situation)) return std::nullopt;
  return map_.TryWrite(kMaxMapWait, [&](Map& map) { return InsertKeyframe(map, &located->frame); });
}

// Nothing if the map cannot be had.
std::optional<KeyframePolicy::Situation> Tracking::Assess(const Located& located,
                                                          const MapperLoad& mapper) const {
  const TrackedFrame& current = located.frame;
  KeyframePolicy::Situation now;
  now.num_frames_since_keyframe = num_frames_since_keyframe_;
  now.num_inliers = located.num_inliers;
  now.mapper = mapper;
  double sum_of_depths = 0;
  for (std::size_t i = 0; i < current.points.size(); ++i) {
    const float depth = current.frame->keypoints[i].depth;
    if (depth <= 0 || depth > options_.close_depth_m) continue;
    ++(current.points[i] ? now.num_close_tracked : now.num_close_untracked);
    sum_of_depths += depth;
  }
  const int num_close = now.num_close_tracked + now.num_close_untracked;
  const double distance = num_close > 0 ? sum_of_depths / num_close : options_.close_depth_m;
  const bool is_known = map_.TryRead(kMaxMapWait, [&](const Map& map) {
    if (const std::optional<KeyframeId> piece = map.PieceOf(last_reference_)) {
      now.num_keyframes = static_cast<int>(map.pieces().at(*piece));
    }
    const int min_measurements = now.num_keyframes <= 2 ? 2 : 3;
    const Keyframe* const keyframe = map.FindKeyframe(last_reference_);
    if (keyframe == nullptr) return;
    now.num_reference_landmarks = map.NumTrackedLandmarks(last_reference_, min_measurements);
    now.new_share = NewShare(camera_, keyframe->T_world_camera, current.T_world_camera, distance);
  });
  return is_known ? std::optional(now) : std::nullopt;
}

KeyframeId Tracking::InsertKeyframe(Map& map, TrackedFrame* current) {
  const NewPointOptions close_points{.close_depth_m = options_.close_depth_m,
                                     .min_count = options_.min_close_points};
  ApplySightings(map);
  FollowCorrection(map, current);
  const KeyframeId id = map.AddKeyframe(current->frame, current->T_world_camera);
  for (std::size_t feature = 0; feature < current->points.size(); ++feature) {
    std::optional<TrackedPoint>& point = current->points[feature];
    if (!point) continue;
    point->landmark = map.ResolveLandmark(*point->landmark);
    // Two features may show landmarks that were merged meanwhile.
    if (!point->landmark || map.Sees(id, *point->landmark)) {
      point.reset();
    } else {
      map.AddObservation(*point->landmark, {id, static_cast<int>(feature)});
    }
  }
  for (const int feature : FeaturesForNewPoints(*current, close_points)) {
    const Eigen::Vector3d p_world = BackProject(camera_, *current, feature);
    current->points[feature] = TrackedPoint{map.AddLandmark(p_world, {id, feature}), p_world};
  }
  map.ChooseParent(id, map.NearestKeptAncestor(last_reference_));
  return id;
}

void Tracking::ApplySightings(Map& map) {
  for (const auto& [id, sightings] : sightings_) {  // Sums: the order does not matter.
    if (const std::optional<LandmarkId> landmark = map.ResolveLandmark(id)) {
      map.CountSightings(*landmark, sightings.num_visible, sightings.num_found);
    }
  }
  sightings_.clear();
}

Tracking::Result Tracking::Fail(std::shared_ptr<const Frame> frame) {
  T_last_next_.reset();
  velocity_.reset();
  sightings_.clear();
  state_ = TrackingState::kLost;
  ++num_frames_lost_;
  num_good_frames_lost_ = CanStartFrom(*frame) ? num_good_frames_lost_ + 1 : 0;
  if (num_frames_lost_ >= num_frames_tracked_ && !localization_only_ && !IsWorthKeeping()) {
    return DropPiece(std::move(frame));
  }
  Result result;
  result.state = state_;
  if (localization_only_ || num_good_frames_lost_ < options_.max_frames_lost) return result;
  result = StartPiece(std::move(frame), last_.T_world_camera);
  result.piece_was_started = true;
  return result;
}

// Whether the piece in which tracking was lost is large enough, or came from elsewhere.
bool Tracking::IsWorthKeeping() const {
  return map_.Read([&](const Map& map) {
    const std::optional<KeyframeId> piece = map.PieceOf(last_reference_);
    if (!piece) return true;  // It is dropped already.
    return map.pieces().at(*piece) > options_.min_keyframes_to_keep ||
           (newest_loaded_ && !(*newest_loaded_ < *piece));
  });
}

// More was lost than was mapped: a fresh start is better; this frame may serve as the first.
Tracking::Result Tracking::DropPiece(std::shared_ptr<const Frame> frame) {
  const bool is_empty = map_.Write([&](Map& map) {
    const std::optional<KeyframeId> piece = map.PieceOf(last_reference_);
    if (piece && map.pieces().size() > 1) {
      map.ErasePiece(*piece);
    } else if (piece) {
      map.Clear();
    }
    return map.num_keyframes() == 0;
  });
  Result result;
  if (is_empty) {
    state_ = TrackingState::kNotInitialized;
    result = Initialize(std::move(frame));
    result.map_was_reset = true;
  } else {
    result.state = state_;  // There are other pieces, in one of which it may be found.
  }
  return result;
}

}  // namespace semslam

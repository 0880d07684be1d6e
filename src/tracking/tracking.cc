// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/tracking/tracking.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "semslam/base/check.h"
#include "semslam/base/stopwatch.h"
#include "semslam/map/similar_places.h"

#include "tracking/frame_matching.h"
#include "tracking/map_wait.h"
#include "tracking/new_points.h"

namespace semslam {
namespace {

// The keyframe, or where it was erased as redundant, the kept one of its piece whose view is
// nearest to its own (a radian counts as a metre). Null if the map was cleared since.
const Keyframe* NearestKeptKeyframe(const Map& map, KeyframeId id) {
  if (const Keyframe* keyframe = map.FindKeyframe(id)) return keyframe;
  const std::optional<Rigid3> T_world_erased = map.ResolvePose(id);
  if (!T_world_erased) return nullptr;
  const std::optional<KeyframeId> piece = map.PieceOf(id);
  const Keyframe* nearest = nullptr;
  double least_difference = std::numeric_limits<double>::infinity();
  for (const KeyframeId candidate : map.KeyframeIds()) {
    const Keyframe& keyframe = map.keyframe(candidate);
    if (keyframe.piece != piece) continue;
    const double difference =
        (keyframe.T_world_camera.translation - T_world_erased->translation).norm() +
        RotationAngle(keyframe.T_world_camera, *T_world_erased);
    if (difference < least_difference) {
      least_difference = difference;
      nearest = &keyframe;
    }
  }
  return nearest;
}

}  // namespace

void Tracking::Options::Validate() const {
  SEMSLAM_CHECK(close_depth_m > 0) << close_depth_m;
  SEMSLAM_CHECK(search_radius_px > 0) << search_radius_px;
  SEMSLAM_CHECK(min_inliers > 0 && min_pose_inliers > 0) << min_inliers << ", " << min_pose_inliers;
  keyframes.Validate();
}

Tracking::Tracking(const Options& options,
                   const PinholeCamera& camera,
                   double baseline_times_fx,
                   std::shared_ptr<const Vocabulary> vocabulary,
                   SharedMap& map)
    : options_(options),
      camera_(camera),
      stereo_(MakeStereoCamera(camera, baseline_times_fx)),
      vocabulary_(std::move(vocabulary)),
      map_(map),
      scale_space_(map.Read([](const Map& m) { return m.scale_space(); })),
      locator_({.min_inliers = options.min_inliers_after_loss},
               camera,
               baseline_times_fx,
               vocabulary_,
               map),
      localization_only_(options.localization_only),
      keyframe_policy_(options.keyframes),
      shutter_(options.shutter, camera, baseline_times_fx) {
  options_.Validate();
  SEMSLAM_CHECK(vocabulary_ != nullptr);
}

void Tracking::StartInLoadedMap() {
  SEMSLAM_CHECK(state_ == TrackingState::kNotInitialized);
  map_.Read([&](const Map& map) {
    const std::vector<KeyframeId> ids = map.KeyframeIds();
    if (ids.empty()) return;
    state_ = TrackingState::kLost;
    newest_loaded_ = ids.back();
    last_reference_ = ids.back();
    epoch_ = map.epoch();
  });
}

void Tracking::StartOver() {
  map_.Write([](Map& map) { map.Clear(); });
  state_ = TrackingState::kNotInitialized;
  newest_loaded_.reset();
  sightings_.clear();
  num_frames_lost_ = num_good_frames_lost_ = 0;
}

Tracking::Result Tracking::Track(std::shared_ptr<const Frame> frame, const MapperLoad& mapper) {
  SEMSLAM_CHECK(frame != nullptr);
  if (state_ == TrackingState::kNotInitialized) return WithSight(Initialize(frame), frame);
  const Stopwatch stopwatch;
  first_pose_seconds_ = local_map_seconds_ = 0;
  Result result = TrackInMap(frame, mapper);
  result.first_pose_seconds = first_pose_seconds_;
  result.local_map_seconds = local_map_seconds_;
  result.keyframe_seconds = stopwatch.Seconds() - first_pose_seconds_ - local_map_seconds_;
  return WithSight(std::move(result), std::move(frame));
}

// Tells what the frame shows, for those who watch.
Tracking::Result Tracking::WithSight(Result result, std::shared_ptr<const Frame> frame) const {
  result.frame = std::move(frame);
  if (result.state != TrackingState::kTracking) return result;
  result.shows_landmark.reserve(last_.points.size());
  for (const std::optional<TrackedPoint>& point : last_.points)
    result.shows_landmark.push_back(point && point->landmark);
  return result;
}

Tracking::Result Tracking::TrackInMap(std::shared_ptr<const Frame> frame,
                                      const MapperLoad& mapper) {
  const Stopwatch stopwatch;
  const auto bring_up_to_date = [&](const Map& map) { BringLastFrameUpToDate(map); };
  if (state_ == TrackingState::kTracking) {
    map_.TryRead(kMaxMapWait, bring_up_to_date);  // Else the frame stays as it was left.
  } else {
    map_.Read(bring_up_to_date);
  }
  first_pose_seconds_ += stopwatch.Seconds();
  std::optional<Located> located = Locate(frame);
  if (MapHasMoved(located.has_value())) {
    // A correction moved the map under the search: once more, where everything is now.
    map_.Read(bring_up_to_date);
    located = Locate(frame);
  }
  if (!located) return Fail(std::move(frame));
  return Succeed(*std::move(located), mapper);
}

// Since the last frame was brought up to date. A frame that was found need not wait to know: its
// local map tells whether it is of two epochs, and if it is not, Succeed and the next frame follow.
bool Tracking::MapHasMoved(bool is_located) const {
  const auto has_moved = [&](const Map& map) { return map.epoch() != epoch_; };
  if (!is_located) return map_.Read(has_moved);
  return map_.TryRead(kMaxMapWait, has_moved).value_or(local_map_.epoch() != epoch_);
}

// The frame's pose in the local map, if enough agrees with it.
std::optional<Tracking::Located> Tracking::Locate(const std::shared_ptr<const Frame>& recorded) {
  Stopwatch stopwatch;
  std::optional<TrackedFrame> current;
  if (state_ == TrackingState::kTracking) current = TrackFromLast(recorded);
  const bool is_lost = !current;
  if (is_lost) current = Relocalize(recorded);
  first_pose_seconds_ += stopwatch.Seconds();
  if (!current) return std::nullopt;
  stopwatch.Restart();
  const int num_inliers = TrackLocalMap(&*current);
  local_map_seconds_ += stopwatch.Seconds();
  const bool was_lost_lately =
      is_lost || num_frames_since_found_ < options_.keyframes.max_frames_between;
  if (num_inliers < (was_lost_lately ? options_.min_inliers_after_loss : options_.min_inliers)) {
    return std::nullopt;
  }
  if (const auto velocity = is_lost ? std::nullopt : VelocityAt(*current)) {
    shutter_.Learn(*recorded, *current, *velocity, scale_space_);
  }
  return Located{*std::move(current), num_inliers, is_lost};
}

// The pose from the last frame's or its keyframe's points. Its velocity says how the rolling
// shutter skewed the frame: first the last frame's, then its own.
std::optional<TrackedFrame> Tracking::TrackFromLast(const std::shared_ptr<const Frame>& recorded) {
  std::optional<TrackedFrame> current =
      PredictAndMatch(velocity_ ? shutter_.Correct(recorded, *velocity_) : recorded);
  if (!current) return std::nullopt;
  const std::optional<Vector6d> velocity = VelocityAt(*current);
  current->frame = velocity ? shutter_.Correct(recorded, *velocity) : recorded;
  return current;
}

// Since the last frame; nothing if that is too long ago to tell.
std::optional<Vector6d> Tracking::VelocityAt(const TrackedFrame& current) const {
  constexpr double kMaxSeconds = 0.2;
  const double seconds = ToSeconds(current.frame->time - last_.frame->time);
  if (!(seconds > 0 && seconds < kMaxSeconds)) return std::nullopt;
  return LocalDifference(last_.T_world_camera, current.T_world_camera) / seconds;
}

Tracking::Result Tracking::Initialize(std::shared_ptr<const Frame> frame) {
  if (localization_only_ || !CanStartFrom(*frame)) return {};
  return StartPiece(std::move(frame), Rigid3());
}

bool Tracking::CanStartFrom(const Frame& frame) const {
  if (static_cast<int>(frame.keypoints.size()) <= options_.min_features_to_start) return false;
  const auto num_points =
      std::count_if(frame.keypoints.begin(), frame.keypoints.end(),
                    [](const Keypoint& keypoint) { return keypoint.has_depth(); });
  return num_points >= options_.min_close_points;
}

Tracking::Result Tracking::StartPiece(std::shared_ptr<const Frame> frame,
                                      const Rigid3& T_world_camera) {
  Result result;
  TrackedFrame first = EmptyFrame(std::move(frame), T_world_camera);
  const NewPointOptions all_points{.close_depth_m = std::numeric_limits<double>::infinity(),
                                   .min_count = 0};
  const KeyframeId id = map_.Write([&](Map& map) {
    const KeyframeId keyframe = map.AddKeyframe(first.frame, first.T_world_camera);
    for (const int feature : FeaturesForNewPoints(first, all_points)) {
      const Eigen::Vector3d p_world = BackProject(camera_, first, feature);
      const LandmarkId landmark = map.AddLandmark(p_world, {keyframe, feature});
      first.points[feature] = TrackedPoint{landmark, p_world};
    }
    epoch_ = map.epoch();
    local_map_.CopyFrom(map, first);
    return keyframe;
  });
  state_ = TrackingState::kTracking;
  num_frames_since_keyframe_ = 0;
  num_frames_tracked_ = 1;
  num_frames_lost_ = num_good_frames_lost_ = 0;
  last_reference_ = id;
  T_reference_last_ = Rigid3();
  T_last_next_.reset();
  velocity_.reset();
  num_frames_since_found_ = options_.keyframes.max_frames_between;
  result.state = state_;
  result.T_world_camera = T_world_camera;
  result.reference_keyframe = id;
  result.num_inliers = first.NumLandmarks();
  result.new_keyframe = id;
  last_ = std::move(first);
  return result;
}

// The map may have moved since the last frame was tracked: its pose follows its reference keyframe,
// and its landmarks may have moved, merged or vanished.
void Tracking::BringLastFrameUpToDate(const Map& map) {
  epoch_ = map.epoch();
  if (const std::optional<Rigid3> T_world_reference = map.ResolvePose(last_reference_)) {
    last_.T_world_camera = *T_world_reference * T_reference_last_;
  }
  for (std::optional<TrackedPoint>& point : last_.points) {
    if (!point || !point->landmark) continue;
    point->landmark = map.ResolveLandmark(*point->landmark);
    if (point->landmark) {
      point->p_world = map.landmark(*point->landmark).appearance.p_world;
    } else {
      point.reset();
    }
  }
}

std::optional<TrackedFrame> Tracking::PredictAndMatch(const std::shared_ptr<const Frame>& frame) {
  // The last frame's depth helps as temporary points: between two keyframes much of the view has no
  // landmark yet.
  const NewPointOptions close_points{.close_depth_m = options_.close_depth_m,
                                     .min_count = options_.min_close_points};
  for (const int feature : FeaturesForNewPoints(last_, close_points)) {
    last_.points[feature] = TrackedPoint{std::nullopt, BackProject(camera_, last_, feature)};
  }
  if (T_last_next_) {
    if (std::optional<TrackedFrame> tracked = TrackWithMotion(frame)) return tracked;
  }
  return TrackKeyframe(frame, last_reference_);
}

std::optional<TrackedFrame> Tracking::TrackWithMotion(
    const std::shared_ptr<const Frame>& frame) const {
  const TrackedFrame predicted = EmptyFrame(frame, last_.T_world_camera * *T_last_next_);
  const ProjectionCamera camera{camera_, stereo_.bf, scale_space_};
  const auto count = [](const TrackedFrame& f) {
    return std::count_if(f.points.begin(), f.points.end(),
                         [](const auto& p) { return p.has_value(); });
  };
  TrackedFrame matched = MatchLastFrame(last_, predicted, camera, options_.search_radius_px);
  if (count(matched) < options_.min_motion_matches) {
    matched = MatchLastFrame(last_, predicted, camera, 2 * options_.search_radius_px);
  }
  if (count(matched) < options_.min_motion_matches) return std::nullopt;
  OptimizeAndDropOutliers(stereo_, scale_space_, &matched);
  for (std::optional<TrackedPoint>& point : matched.points) {
    if (point && !point->landmark) point.reset();  // Temporary points have done their duty.
  }
  if (matched.NumLandmarks() < options_.min_pose_inliers) return std::nullopt;
  return matched;
}

// Serves where the map with its keyframes cannot be had.
KnownKeyframe Tracking::LastFrameAsKeyframe() const {
  KnownKeyframe known{last_.frame, nullptr, last_.points};
  for (std::optional<TrackedPoint>& point : known.points) {
    if (point && !point->landmark) point.reset();
  }
  return known;
}

std::optional<TrackedFrame> Tracking::TrackKeyframe(const std::shared_ptr<const Frame>& frame,
                                                    KeyframeId keyframe_id) const {
  const auto copied =
      map_.TryRead(kMaxMapWait, [&](const Map& map) -> std::optional<KnownKeyframe> {
        const Keyframe* keyframe = NearestKeptKeyframe(map, keyframe_id);
        if (keyframe == nullptr) return std::nullopt;
        return CopyKnownKeyframe(map, *keyframe);
      });
  const std::optional<KnownKeyframe> reference = copied ? *copied : LastFrameAsKeyframe();
  if (!reference) return std::nullopt;
  const std::vector<FeatureMatch> matches = MatchKnownKeyframe(
      *reference, *frame, vocabulary_->Transform(frame->descriptors), *vocabulary_);
  if (static_cast<int>(matches.size()) < options_.min_reference_matches) return std::nullopt;

  TrackedFrame matched = EmptyFrame(frame, last_.T_world_camera);
  for (const FeatureMatch& match : matches)
    matched.points[match.feature] = reference->points[match.query];
  OptimizeAndDropOutliers(stereo_, scale_space_, &matched);
  if (matched.NumLandmarks() < options_.min_pose_inliers) return std::nullopt;
  return matched;
}

// After a loss: the keyframes where it was lost, then all that look like the frame.
std::optional<TrackedFrame> Tracking::Relocalize(const std::shared_ptr<const Frame>& frame) const {
  if (static_cast<int>(frame->keypoints.size()) < options_.min_inliers_after_loss) {
    return std::nullopt;
  }
  const BagOfWords words = vocabulary_->Transform(frame->descriptors);
  const std::vector<KeyframeId> places = map_.Read([&](const Map& map) {
    std::vector<KeyframeId> ids = FindSimilarPlaces(map, words.vector, {});
    if (const Keyframe* nearest = NearestKeptKeyframe(map, last_reference_)) {
      std::erase(ids, nearest->id);
      ids.insert(ids.begin(), nearest->id);
    }
    return ids;
  });
  for (std::size_t i = 0; i < std::min(places.size(), options_.max_places_tried); ++i) {
    if (auto located = locator_.Locate(frame, words, places[i])) return located;
  }
  return std::nullopt;
}

int Tracking::TrackLocalMap(TrackedFrame* current) {
  if (!local_map_.Update(map_, *current, epoch_)) return 0;
  for (const std::optional<TrackedPoint>& point : current->points) {
    if (point) ++sightings_[*point->landmark].num_visible;
  }
  const bool was_lost_lately = num_frames_since_found_ < 2;
  const float radius_factor = was_lost_lately ? 5.0F : 3.0F;
  for (const LandmarkId searched : SearchLandmarks(
           local_map_.landmarks(), {camera_, stereo_.bf, scale_space_}, radius_factor, current)) {
    ++sightings_[searched].num_visible;
  }
  const int num_inliers = OptimizeAndDropOutliers(stereo_, scale_space_, current);
  for (const std::optional<TrackedPoint>& point : current->points) {
    if (point) ++sightings_[*point->landmark].num_found;
  }
  return num_inliers;
}

}  // namespace semslam

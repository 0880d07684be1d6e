// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/tracking/frame_locator.h"

#include <cmath>
#include <utility>
#include <vector>

#include "semslam/base/check.h"

#include "tracking/frame_matching.h"
#include "tracking/pose_from_pixels.h"

namespace semslam {
namespace {

// A feature of the frame that seems to show a landmark, with depth.
struct Pair {
  int feature = 0;
  TrackedPoint point;
  Eigen::Vector3d p_camera;
};

// Whether a hypothesis explains a pair. Generous, because a motion from three measured depths is a
// rough one: a degree off where the depth is 2 % off. The optimisation that follows is strict.
class PairCheck {
 public:
  PairCheck(const PinholeCamera& camera, const ScaleSpace& scale_space, const Frame& frame)
      : camera_(camera), scale_space_(scale_space), frame_(frame) {}

  bool Agrees(const Rigid3& T_world_camera, const Pair& pair) const {
    constexpr double kMaxPixels = 8;  // At the finest level.
    constexpr double kMaxDepthError = 0.05;
    constexpr double kDepthErrorGrowth = 0.02;  // 1 / m: the depth noise grows with the square.
    const Eigen::Vector3d p_camera =
        T_world_camera.rotation.conjugate() * (pair.point.p_world - T_world_camera.translation);
    const double z = pair.p_camera.z();
    if (p_camera.z() <= 0) return false;
    if (std::abs(p_camera.z() - z) > kMaxDepthError + kDepthErrorGrowth * z * z) return false;
    const Keypoint& keypoint = frame_.keypoints[pair.feature];
    const double error = (camera_.Project(p_camera) - keypoint.pixel.cast<double>()).norm();
    return error <= kMaxPixels * scale_space_.PixelSize(keypoint.octave);
  }

 private:
  const PinholeCamera& camera_;
  const ScaleSpace& scale_space_;
  const Frame& frame_;
};

}  // namespace

void FrameLocator::Options::Validate() const {
  SEMSLAM_CHECK(min_word_matches > 0) << min_word_matches;
  SEMSLAM_CHECK(min_pose_inliers > 0 && min_inliers > 0) << min_pose_inliers << ", " << min_inliers;
  SEMSLAM_CHECK(min_found_share >= 0 && min_found_share < 1) << min_found_share;
  ransac.Validate();
}

FrameLocator::FrameLocator(const Options& options,
                           const PinholeCamera& camera,
                           double baseline_times_fx,
                           std::shared_ptr<const Vocabulary> vocabulary,
                           const SharedMap& map)
    : options_(options),
      camera_(camera),
      stereo_(MakeStereoCamera(camera, baseline_times_fx)),
      vocabulary_(std::move(vocabulary)),
      map_(map),
      scale_space_(map.Read([](const Map& m) { return m.scale_space(); })) {
  options_.Validate();
  SEMSLAM_CHECK(vocabulary_ != nullptr);
}

std::optional<TrackedFrame> FrameLocator::Locate(const std::shared_ptr<const Frame>& frame,
                                                 const BagOfWords& words,
                                                 KeyframeId place_id) const {
  const std::optional<KnownKeyframe> place =
      map_.Read([&](const Map& map) -> std::optional<KnownKeyframe> {
        const Keyframe* keyframe = map.FindKeyframe(place_id);
        if (keyframe == nullptr) return std::nullopt;
        return CopyKnownKeyframe(map, *keyframe);
      });
  if (!place) return std::nullopt;
  std::optional<TrackedFrame> located = MatchPlace(frame, words, *place);
  if (!located) return std::nullopt;
  // Once more from the better pose if it is not enough yet.
  Support support = SearchNeighbourhood(place_id, &*located);
  if (support.num_inliers >= options_.min_pose_inliers &&
      support.num_inliers < options_.min_inliers) {
    support = SearchNeighbourhood(place_id, &*located);
  }
  if (support.num_inliers < options_.min_inliers) return std::nullopt;
  if (support.num_inliers < options_.min_found_share * support.num_visible) return std::nullopt;
  return located;
}

// The pose from pairs with equal words: by consensus, then optimised.
std::optional<TrackedFrame> FrameLocator::MatchPlace(const std::shared_ptr<const Frame>& frame,
                                                     const BagOfWords& words,
                                                     const KnownKeyframe& place) const {
  const std::vector<FeatureMatch> matches = MatchKnownKeyframe(place, *frame, words, *vocabulary_);
  if (static_cast<int>(matches.size()) < options_.min_word_matches) return std::nullopt;

  std::optional<TrackedFrame> located = FromDepth(frame, matches, place);
  if (!located) located = FromPixels(frame, matches, place);
  if (!located ||
      OptimizeAndDropOutliers(stereo_, scale_space_, &*located) < options_.min_pose_inliers) {
    return std::nullopt;
  }
  return located;
}

std::optional<TrackedFrame> FrameLocator::FromDepth(const std::shared_ptr<const Frame>& frame,
                                                    std::span<const FeatureMatch> matches,
                                                    const KnownKeyframe& place) const {
  std::vector<Pair> pairs;
  std::vector<Eigen::Vector3d> p_world;
  std::vector<Eigen::Vector3d> p_camera;
  for (const FeatureMatch& match : matches) {
    const Keypoint& keypoint = frame->keypoints[match.feature];
    if (!keypoint.has_depth()) continue;
    p_world.push_back(place.points[match.query]->p_world);
    p_camera.push_back(camera_.Unproject(keypoint.pixel.cast<double>(), keypoint.depth));
    pairs.push_back({match.feature, *place.points[match.query], p_camera.back()});
  }
  const PairCheck check(camera_, scale_space_, *frame);
  const std::optional<RigidConsensus> consensus = FindRigidConsensus(
      p_world, p_camera,
      [&](const Rigid3& T_world_camera, std::size_t i) {
        return check.Agrees(T_world_camera, pairs[i]);
      },
      options_.ransac);
  if (!consensus) return std::nullopt;

  TrackedFrame located = EmptyFrame(frame, consensus->T_a_b);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (consensus->is_inlier[i] != 0) located.points[pairs[i].feature] = pairs[i].point;
  }
  return located;
}

// Where the sensor sees no depth: too far, too close, or against the light.
std::optional<TrackedFrame> FrameLocator::FromPixels(const std::shared_ptr<const Frame>& frame,
                                                     std::span<const FeatureMatch> matches,
                                                     const KnownKeyframe& place) const {
  constexpr double kMaxPixels = 8;
  std::vector<Eigen::Vector3d> p_world;
  std::vector<Eigen::Vector2d> pixels;
  for (const FeatureMatch& match : matches) {
    p_world.push_back(place.points[match.query]->p_world);
    pixels.push_back(frame->keypoints[match.feature].pixel.cast<double>());
  }
  const std::optional<PixelConsensus> consensus =
      FindPoseFromPixels(camera_, p_world, pixels, kMaxPixels, options_.ransac);
  if (!consensus) return std::nullopt;
  TrackedFrame located = EmptyFrame(frame, consensus->T_world_camera);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (consensus->is_inlier[i] != 0)
      located.points[matches[i].feature] = place.points[matches[i].query];
  }
  return located;
}

// Looks for the landmarks of the place and around it.
FrameLocator::Support FrameLocator::SearchNeighbourhood(KeyframeId place,
                                                        TrackedFrame* located) const {
  constexpr float kRadiusFactor = 4.0F;  // Windows of 10 pixels and more.
  const std::vector<LandmarkCopy> landmarks = map_.Read([&](const Map& map) {
    if (map.FindKeyframe(place) == nullptr) return std::vector<LandmarkCopy>();
    std::vector<KeyframeId> keyframes = map.CovisibleKeyframes(place, 1, options_.num_neighbours);
    keyframes.push_back(place);
    return map.CopyLandmarksSeenBy(keyframes);
  });
  const int num_shown = located->NumLandmarks();
  const std::vector<LandmarkId> searched =
      SearchLandmarks(landmarks, {camera_, stereo_.bf, scale_space_}, kRadiusFactor, located);
  return {OptimizeAndDropOutliers(stereo_, scale_space_, located),
          num_shown + static_cast<int>(searched.size())};
}

}  // namespace semslam

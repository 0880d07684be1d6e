// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tracking/frame_matching.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "semslam/optim/pose_optimizer.h"
#include "semslam/place/word_matcher.h"

namespace semslam {
namespace {

// When the camera moves forward things grow, so they are found at the same or a coarser level;
// backward the reverse.
struct OctaveRange {
  int below = 1;  // Levels finer than in the last frame.
  int above = 1;
};
OctaveRange RangeForMotion(const Rigid3& T_last_current, double baseline, int num_levels) {
  const double forward = T_last_current.translation.z();
  if (forward > baseline) return {0, num_levels};
  if (-forward > baseline) return {num_levels, 0};
  return {1, 1};
}

// Pixels: wider where the landmark is seen from an unusual side.
float WindowSize(float view_cosine) {
  constexpr float kFrontalViewCosine = 0.998F;
  return view_cosine > kFrontalViewCosine ? 2.5F : 4.0F;
}

}  // namespace

KnownKeyframe CopyKnownKeyframe(const Map& map, const Keyframe& keyframe) {
  KnownKeyframe copy{keyframe.frame, keyframe.words, {}};
  copy.points.resize(keyframe.landmarks.size());
  for (std::size_t i = 0; i < copy.points.size(); ++i) {
    if (const std::optional<LandmarkId> id = keyframe.landmarks[i]) {
      copy.points[i] = TrackedPoint{id, map.landmark(*id).appearance.p_world};
    }
  }
  return copy;
}

std::vector<FeatureMatch> MatchKnownKeyframe(const KnownKeyframe& keyframe,
                                             const Frame& frame,
                                             const BagOfWords& words,
                                             const Vocabulary& vocabulary) {
  std::vector<std::uint8_t> has_point(keyframe.points.size(), 0);
  for (std::size_t i = 0; i < has_point.size(); ++i) has_point[i] = keyframe.points[i] ? 1 : 0;
  const BagOfWords keyframe_words =
      keyframe.words ? *keyframe.words : vocabulary.Transform(keyframe.frame->descriptors);
  return MatchByWords({*keyframe.frame, keyframe_words, has_point}, {frame, words, {}}, {});
}

TrackedFrame EmptyFrame(std::shared_ptr<const Frame> frame, const Rigid3& T_world_camera) {
  TrackedFrame tracked;
  tracked.points.resize(frame->keypoints.size());
  tracked.frame = std::move(frame);
  tracked.T_world_camera = T_world_camera;
  return tracked;
}

TrackedFrame MatchLastFrame(const TrackedFrame& last,
                            const TrackedFrame& predicted,
                            const ProjectionCamera& camera,
                            float radius_px) {
  const Rigid3 T_camera_world = predicted.T_world_camera.Inverse();
  const OctaveRange range =
      RangeForMotion(last.T_world_camera.Inverse() * predicted.T_world_camera,
                     camera.baseline_times_fx / camera.camera.fx(), camera.scale_space.num_levels);
  std::vector<ProjectedPoint> projections;
  std::vector<int> last_features;
  for (std::size_t i = 0; i < last.points.size(); ++i) {
    if (!last.points[i]) continue;
    const Eigen::Vector3d p_camera = T_camera_world * last.points[i]->p_world;
    if (p_camera.z() <= 0) continue;
    const Eigen::Vector2d pixel = camera.camera.Project(p_camera);
    if (!camera.camera.ideal_bounds().Contains(pixel)) continue;
    const int octave = last.frame->keypoints[i].octave;
    ProjectedPoint point;
    point.pixel = pixel.cast<float>();
    point.right_x = static_cast<float>(pixel.x() - camera.baseline_times_fx / p_camera.z());
    point.radius = radius_px * camera.scale_space.PixelSize(octave);
    point.min_octave = std::max(0, octave - range.below);
    point.max_octave = std::min(camera.scale_space.num_levels - 1, octave + range.above);
    point.descriptor = last.frame->descriptors[i];
    projections.push_back(point);
    last_features.push_back(static_cast<int>(i));
  }

  std::vector<FeatureMatch> matches = MatchProjectedPoints(projections, *predicted.frame, {}, {});
  std::vector<float> turns;
  for (const FeatureMatch& match : matches) {
    turns.push_back(last.frame->keypoints[last_features[match.query]].angle -
                    predicted.frame->keypoints[match.feature].angle);
  }
  matches = KeepConsistentTurns(matches, turns);
  TrackedFrame matched = predicted;
  for (const FeatureMatch& match : matches) {
    matched.points[match.feature] = last.points[last_features[match.query]];
  }
  return matched;
}

std::vector<LandmarkId> SearchLandmarks(const std::vector<LandmarkCopy>& landmarks,
                                        const ProjectionCamera& camera,
                                        float radius_factor,
                                        TrackedFrame* frame) {
  constexpr float kMaxRatio = 0.8F;
  std::vector<std::uint8_t> is_taken(frame->points.size(), 0);
  std::vector<LandmarkId> shown;
  for (std::size_t i = 0; i < frame->points.size(); ++i) {
    if (!frame->points[i]) continue;
    is_taken[i] = 1;
    if (frame->points[i]->landmark) shown.push_back(*frame->points[i]->landmark);
  }
  std::sort(shown.begin(), shown.end());

  std::vector<std::size_t> searched;
  std::vector<ProjectedPoint> projections;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    std::optional<LandmarkProjection> projection =
        ProjectLandmark(camera, frame->T_world_camera, landmarks[i].appearance);
    if (!projection || std::binary_search(shown.begin(), shown.end(), landmarks[i].id)) continue;
    projection->point.radius *= radius_factor * WindowSize(projection->view_cosine);
    projections.push_back(projection->point);
    searched.push_back(i);
  }
  for (const FeatureMatch& match :
       MatchProjectedPoints(projections, *frame->frame, is_taken, {.max_ratio = kMaxRatio})) {
    const LandmarkCopy& entry = landmarks[searched[match.query]];
    frame->points[match.feature] = TrackedPoint{entry.id, entry.appearance.p_world};
  }
  std::vector<LandmarkId> ids;
  for (const std::size_t i : searched) ids.push_back(landmarks[i].id);
  return ids;
}

int OptimizeAndDropOutliers(const StereoCamera& stereo,
                            const ScaleSpace& scale_space,
                            TrackedFrame* frame) {
  std::vector<PoseObservation> observations;
  std::vector<std::size_t> features;
  for (std::size_t i = 0; i < frame->points.size(); ++i) {
    if (!frame->points[i]) continue;
    const Keypoint& keypoint = frame->frame->keypoints[i];
    observations.push_back({frame->points[i]->p_world,
                            {keypoint.pixel.cast<double>(), keypoint.right_x,
                             1.0 / scale_space.PixelVariance(keypoint.octave)}});
    features.push_back(i);
  }
  const PoseSolution solution = OptimizePose(stereo, frame->T_world_camera, observations);
  frame->T_world_camera = solution.T_world_camera;
  for (std::size_t k = 0; k < features.size(); ++k) {
    if (solution.is_inlier[k] == 0) frame->points[features[k]].reset();
  }
  return solution.num_inliers;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tracking/frame_matching.h"

#include <algorithm>
#include <cmath>

#include "semslam/optim/pose_optimizer.h"

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

}  // namespace

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

std::vector<VisibleLandmark> FindVisible(const std::vector<LocalMap::Entry>& local_map,
                                         const TrackedFrame& frame,
                                         const ProjectionCamera& camera,
                                         float radius_factor) {
  constexpr float kFrontalViewCosine = 0.998F;
  constexpr float kFrontalRadius = 2.5F;
  constexpr float kObliqueRadius = 4.0F;
  std::vector<VisibleLandmark> visible;
  for (std::size_t i = 0; i < local_map.size(); ++i) {
    std::optional<LandmarkProjection> projection =
        ProjectLandmark(camera, frame.T_world_camera, local_map[i].appearance);
    if (!projection) continue;
    projection->point.radius *=
        radius_factor *
        (projection->view_cosine > kFrontalViewCosine ? kFrontalRadius : kObliqueRadius);
    visible.push_back({i, projection->point});
  }
  return visible;
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

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/mapping/landmark_search.h"

#include <algorithm>
#include <cmath>

#include "semslam/optim/camera_model.h"

namespace semslam {
namespace {

bool AgreesWith(const ProjectedPoint& point,
                const Keypoint& keypoint,
                const ScaleSpace& scale_space) {
  double error2 = (point.pixel - keypoint.pixel).squaredNorm();
  const ImagePoint image{keypoint.pixel.cast<double>(), keypoint.right_x, 1.0};
  if (image.has_right()) error2 += std::pow(point.right_x - keypoint.right_x, 2.0);
  return error2 <= Chi2Limits().Of(image) * scale_space.PixelVariance(keypoint.octave);
}

}  // namespace

std::vector<LandmarkHit> FindLandmarks(const ProjectionCamera& camera,
                                       const KeyframeCopy& keyframe,
                                       std::span<const LandmarkCopy> landmarks,
                                       const LandmarkSearchOptions& options) {
  std::vector<LandmarkId> seen;
  for (const std::optional<LandmarkId> id : keyframe.landmarks) {
    if (id) seen.push_back(*id);
  }
  std::sort(seen.begin(), seen.end());
  std::vector<ProjectedPoint> points;
  std::vector<LandmarkId> ids;
  for (const LandmarkCopy& landmark : landmarks) {
    if (std::binary_search(seen.begin(), seen.end(), landmark.id)) continue;
    const auto projection = ProjectLandmark(camera, keyframe.T_world_camera, landmark.appearance);
    if (!projection) continue;
    points.push_back(projection->point);
    points.back().radius *= options.radius;
    ids.push_back(landmark.id);
  }
  std::vector<LandmarkHit> hits;
  for (const FeatureMatch& match :
       MatchProjectedPoints(points, *keyframe.frame, {}, {.max_distance = kStrictHammingLimit})) {
    if (options.must_agree_well &&
        !AgreesWith(points[match.query], keyframe.frame->keypoints[match.feature],
                    camera.scale_space)) {
      continue;
    }
    hits.push_back({ids[match.query], match.feature});
  }
  return hits;
}

int FuseHits(KeyframeId keyframe, std::span<const LandmarkHit> hits, Map& map) {
  if (map.FindKeyframe(keyframe) == nullptr) return 0;
  int num_fused = 0;
  for (const LandmarkHit& hit : hits) {
    const std::optional<LandmarkId> landmark = map.ResolveLandmark(hit.landmark);
    if (!landmark || map.Sees(keyframe, *landmark)) continue;
    const std::optional<LandmarkId> other = map.keyframe(keyframe).landmarks[hit.feature];
    if (!other) {
      map.AddObservation(*landmark, {keyframe, hit.feature});
    } else {
      const bool keep_other =
          map.landmark(*other).num_measurements > map.landmark(*landmark).num_measurements;
      map.MergeLandmarks(keep_other ? *other : *landmark, keep_other ? *landmark : *other);
    }
    ++num_fused;
  }
  return num_fused;
}

}  // namespace semslam

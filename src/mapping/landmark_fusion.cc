// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "mapping/landmark_fusion.h"

#include <algorithm>
#include <cmath>

#include "semslam/map/landmark_projection.h"

namespace semslam {
namespace {

struct Candidate {
  LandmarkId id;
  LandmarkAppearance appearance;
};

// A landmark that a keyframe's feature seems to show.
struct Hit {
  LandmarkId landmark;
  int feature;
};

std::vector<KeyframeId> TargetsOf(const Map& map,
                                  KeyframeId keyframe,
                                  const FusionOptions& options) {
  std::vector<KeyframeId> targets;
  if (map.FindKeyframe(keyframe) == nullptr) return targets;
  targets = map.CovisibleKeyframes(keyframe, 1, options.num_neighbours);
  const std::size_t num_first = targets.size();
  for (std::size_t i = 0; i < num_first; ++i) {
    const std::vector<KeyframeId> second =
        map.CovisibleKeyframes(targets[i], 1, options.num_second_neighbours);
    targets.insert(targets.end(), second.begin(), second.end());
  }
  std::sort(targets.begin(), targets.end());
  targets.erase(std::unique(targets.begin(), targets.end()), targets.end());
  std::erase(targets, keyframe);
  return targets;
}

std::vector<Candidate> CopyLandmarks(const Map& map, const std::vector<KeyframeId>& keyframes) {
  std::vector<Candidate> candidates;
  for (const LandmarkId id : map.LandmarksSeenBy(keyframes)) {
    candidates.push_back({id, map.landmark(id).appearance});
  }
  return candidates;
}

bool AgreesWith(const ProjectedPoint& point,
                const Keypoint& keypoint,
                const ScaleSpace& scale_space) {
  double error2 = (point.pixel - keypoint.pixel).squaredNorm();
  const ImagePoint image{keypoint.pixel.cast<double>(), keypoint.right_x, 1.0};
  if (image.has_right()) error2 += std::pow(point.right_x - keypoint.right_x, 2.0);
  return error2 <= Chi2Limits().Of(image) * scale_space.PixelVariance(keypoint.octave);
}

std::vector<Hit> SearchIn(const MappingContext& context,
                          const ScaleSpace& scale_space,
                          const KeyframeCopy& target,
                          const std::vector<Candidate>& candidates) {
  std::vector<LandmarkId> seen;
  for (const std::optional<LandmarkId> id : target.landmarks) {
    if (id) seen.push_back(*id);
  }
  std::sort(seen.begin(), seen.end());
  constexpr float kRadius = 3.0F;  // Pixels of the level where it is expected.
  const ProjectionCamera camera{context.camera, context.stereo.bf, scale_space};
  std::vector<ProjectedPoint> points;
  std::vector<LandmarkId> ids;
  for (const Candidate& candidate : candidates) {
    if (std::binary_search(seen.begin(), seen.end(), candidate.id)) continue;
    const auto projection = ProjectLandmark(camera, target.T_world_camera, candidate.appearance);
    if (!projection) continue;
    points.push_back(projection->point);
    points.back().radius *= kRadius;
    ids.push_back(candidate.id);
  }
  std::vector<Hit> hits;
  for (const FeatureMatch& match :
       MatchProjectedPoints(points, *target.frame, {}, {.max_distance = kStrictHammingLimit})) {
    if (AgreesWith(points[match.query], target.frame->keypoints[match.feature], scale_space)) {
      hits.push_back({ids[match.query], match.feature});
    }
  }
  return hits;
}

int Commit(Map& map, KeyframeId keyframe, const std::vector<Hit>& hits) {
  if (map.FindKeyframe(keyframe) == nullptr) return 0;
  int num_committed = 0;
  for (const Hit& hit : hits) {
    const std::optional<LandmarkId> landmark = map.ResolveLandmark(hit.landmark);
    if (!landmark || map.Sees(keyframe, *landmark)) continue;
    const std::optional<LandmarkId> other = map.keyframe(keyframe).landmarks[hit.feature];
    if (!other) {
      map.AddObservation(*landmark, {keyframe, hit.feature});
    } else {
      // The one known from more views stays.
      const bool keep_other =
          map.landmark(*other).num_measurements > map.landmark(*landmark).num_measurements;
      map.MergeLandmarks(keep_other ? *other : *landmark, keep_other ? *landmark : *other);
    }
    ++num_committed;
  }
  return num_committed;
}

int FuseInto(const MappingContext& context,
             KeyframeId target,
             const std::vector<KeyframeId>& sources) {
  struct Copy {
    ScaleSpace scale_space;
    std::optional<KeyframeCopy> target;
    std::vector<Candidate> candidates;
  };
  const Copy copy = context.map.Read([&](const Map& map) {
    Copy c{map.scale_space(), std::nullopt, CopyLandmarks(map, sources)};
    if (const Keyframe* keyframe = map.FindKeyframe(target)) c.target = CopyKeyframe(*keyframe);
    return c;
  });
  if (!copy.target) return 0;
  const std::vector<Hit> hits = SearchIn(context, copy.scale_space, *copy.target, copy.candidates);
  return context.map.Write([&](Map& map) { return Commit(map, target, hits); });
}

}  // namespace

int FuseWithNeighbours(const MappingContext& context,
                       KeyframeId keyframe,
                       const FusionOptions& options) {
  const std::vector<KeyframeId> targets =
      context.map.Read([&](const Map& map) { return TargetsOf(map, keyframe, options); });
  int num_fused = 0;
  for (const KeyframeId target : targets) num_fused += FuseInto(context, target, {keyframe});
  return num_fused + FuseInto(context, keyframe, targets);
}

}  // namespace semslam

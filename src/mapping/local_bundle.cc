// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "mapping/local_bundle.h"

#include <algorithm>
#include <map>
#include <vector>

#include "mapping/appearance_update.h"

namespace semslam {
namespace {

// The problem, and whose its rows are.
struct LocalProblem {
  BundleProblem bundle;
  std::vector<KeyframeId> keyframes;      // One a pose; the moving ones first.
  std::vector<LandmarkId> landmarks;      // One a point.
  std::vector<Observation> observations;  // One an observation.
  std::size_t num_moving = 0;
  std::uint64_t epoch = 0;
};

std::vector<KeyframeId> MovingKeyframes(const Map& map,
                                        KeyframeId center,
                                        const LocalBundleOptions& options) {
  std::vector<KeyframeId> moving =
      map.CovisibleKeyframes(center, options.min_shared, options.max_keyframes - 1);
  moving.push_back(center);
  std::sort(moving.begin(), moving.end());
  return moving;
}

ImagePoint ToImagePoint(const Keypoint& keypoint, const ScaleSpace& scale_space) {
  return {keypoint.pixel.cast<double>(), keypoint.right_x,
          1.0 / scale_space.PixelVariance(keypoint.octave)};
}

LocalProblem BuildProblem(const Map& map,
                          KeyframeId center,
                          const StereoCamera& camera,
                          const LocalBundleOptions& options) {
  LocalProblem problem;
  if (map.FindKeyframe(center) == nullptr) return problem;
  problem.epoch = map.epoch();
  problem.bundle.camera = camera;
  problem.keyframes = MovingKeyframes(map, center, options);
  problem.num_moving = problem.keyframes.size();
  problem.landmarks = map.LandmarksSeenBy(problem.keyframes);
  std::map<KeyframeId, int> pose_of;
  for (std::size_t i = 0; i < problem.keyframes.size(); ++i)
    pose_of[problem.keyframes[i]] = static_cast<int>(i);

  for (std::size_t point = 0; point < problem.landmarks.size(); ++point) {
    const Landmark& landmark = map.landmark(problem.landmarks[point]);
    problem.bundle.p_world.push_back(landmark.appearance.p_world);
    for (const Observation& observation : landmark.observations) {
      const auto [it, is_new] =
          pose_of.try_emplace(observation.keyframe, static_cast<int>(problem.keyframes.size()));
      if (is_new) problem.keyframes.push_back(observation.keyframe);
      const Frame& frame = *map.keyframe(observation.keyframe).frame;
      problem.bundle.observations.push_back(
          {it->second, static_cast<int>(point),
           ToImagePoint(frame.keypoints[observation.feature], map.scale_space())});
      problem.observations.push_back(observation);
    }
  }
  for (std::size_t i = 0; i < problem.keyframes.size(); ++i) {
    const Keyframe& keyframe = map.keyframe(problem.keyframes[i]);
    const bool is_origin = !keyframe.parent;
    problem.bundle.T_world_camera.push_back(keyframe.T_world_camera);
    problem.bundle.pose_is_fixed.push_back(i >= problem.num_moving || is_origin ? 1 : 0);
  }
  // Something must hold the whole in place.
  auto& is_fixed = problem.bundle.pose_is_fixed;
  if (std::find(is_fixed.begin(), is_fixed.end(), 1) == is_fixed.end()) is_fixed.front() = 1;
  return problem;
}

void Commit(const LocalProblem& problem, const BundleSolution& solution, Map& map) {
  for (std::size_t i = 0; i < problem.num_moving; ++i) {
    if (problem.bundle.pose_is_fixed[i] != 0) continue;
    if (map.FindKeyframe(problem.keyframes[i]) != nullptr) {
      map.SetPose(problem.keyframes[i], solution.T_world_camera[i]);
    }
  }
  for (std::size_t i = 0; i < problem.landmarks.size(); ++i) {
    if (map.FindLandmark(problem.landmarks[i]) != nullptr) {
      map.SetPosition(problem.landmarks[i], solution.p_world[i]);
    }
  }
  for (std::size_t i = 0; i < problem.observations.size(); ++i) {
    if (solution.is_inlier[i] != 0) continue;
    const LandmarkId landmark = problem.landmarks[problem.bundle.observations[i].point];
    const KeyframeId keyframe = problem.observations[i].keyframe;
    if (map.FindLandmark(landmark) != nullptr && map.Sees(keyframe, landmark)) {
      map.RemoveObservation(landmark, keyframe);
    }
  }
}

}  // namespace

LocalBundleReport AdjustNeighbourhood(const MappingContext& context,
                                      KeyframeId keyframe,
                                      const LocalBundleOptions& options,
                                      const std::function<bool()>& should_stop) {
  const LocalProblem problem = context.map.Read(
      [&](const Map& map) { return BuildProblem(map, keyframe, context.stereo, options); });
  LocalBundleReport report;
  if (problem.keyframes.size() < 2) return report;

  BundleOptions bundle_options = options.bundle;
  bundle_options.should_stop = should_stop;
  const BundleSolution solution = AdjustBundle(problem.bundle, bundle_options);
  report.seconds = solution.seconds;
  const bool committed = context.map.Write([&](Map& map) {
    if (map.epoch() != problem.epoch) return false;
    Commit(problem, solution, map);
    return true;
  });
  report.finished = committed && !solution.stopped;
  if (committed) UpdateAppearances(context.map, problem.landmarks);
  return report;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/loop/loop_closing.h"

#include "semslam/base/check.h"
#include "semslam/base/stopwatch.h"

#include "loop/loop_correction.h"
#include "loop/loop_detector.h"

namespace semslam {

void LoopClosing::Options::Validate() const {
  SEMSLAM_CHECK(num_consistent > 0) << num_consistent;
  SEMSLAM_CHECK(min_shared > 0 && min_shared_essential >= min_shared)
      << min_shared << ", " << min_shared_essential;
  SEMSLAM_CHECK(min_hits_for_edge > 0) << min_hits_for_edge;
  locator.Validate();
  pose_graph.Validate();
}

LoopClosing::LoopClosing(const Options& options,
                         const PinholeCamera& camera,
                         double baseline_times_fx,
                         std::shared_ptr<const Vocabulary> vocabulary,
                         SharedMap& map)
    : options_(options),
      camera_(camera),
      baseline_times_fx_(baseline_times_fx),
      map_(map),
      locator_(options.locator, camera, baseline_times_fx, std::move(vocabulary), map),
      detector_(std::make_unique<LoopDetector>(LoopDetectorOptions{
          options.min_keyframes_between, options.num_consistent, options.min_shared})) {
  options_.Validate();
}

LoopClosing::~LoopClosing() = default;

std::optional<LoopClosing::Loop> LoopClosing::Process(KeyframeId keyframe_id) {
  struct Current {
    std::uint64_t epoch = 0;
    std::vector<KeyframeId> candidates;
    KeyframeCopy keyframe;
  };
  const Stopwatch stopwatch;
  const Current current = map_.Read([&](const Map& map) {
    Current c{map.epoch(), detector_->FindCandidates(map, keyframe_id), {}};
    if (!c.candidates.empty()) c.keyframe = CopyKeyframe(map.keyframe(keyframe_id));
    return c;
  });
  const Rigid3& T_world_keyframe = current.keyframe.T_world_camera;
  for (const KeyframeId place : current.candidates) {
    const std::optional<TrackedFrame> located =
        locator_.Locate(current.keyframe.frame, *current.keyframe.words, place);
    if (!located) continue;
    const LoopMatch match{keyframe_id, place, located->T_world_camera, current.epoch};
    const std::optional<LoopCorrection> correction =
        CorrectLoop(camera_, baseline_times_fx_, match, loop_edges_,
                    {options_.min_shared, options_.min_shared_essential, options_.min_hits_for_edge,
                     options_.pose_graph},
                    map_);
    if (!correction) return std::nullopt;  // The map was moved meanwhile; the next will see it.
    detector_->LoopClosed(keyframe_id);
    loop_edges_.insert(loop_edges_.end(), correction->edges.begin(), correction->edges.end());
    return Loop{
        .keyframe = keyframe_id,
        .place = place,
        .num_matches = located->NumLandmarks(),
        .num_fused = correction->num_fused,
        .distance = (T_world_keyframe.translation - located->T_world_camera.translation).norm(),
        .angle = RotationAngle(T_world_keyframe, located->T_world_camera),
        .seconds = stopwatch.Seconds()};
  }
  return std::nullopt;
}

}  // namespace semslam

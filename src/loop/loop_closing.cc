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

struct LoopClosing::Candidate {
  KeyframeId place;
  bool is_apart = false;  // In another piece of the map.
};

std::optional<LoopClosing::Loop> LoopClosing::Process(KeyframeId keyframe_id) {
  struct Current {
    std::uint64_t epoch = 0;
    std::vector<Candidate> candidates;
    KeyframeCopy keyframe;
  };
  const Stopwatch stopwatch;
  const Current current = map_.Read([&](const Map& map) {
    Current c{map.epoch(), {}, {}};
    for (const KeyframeId place : detector_->FindCandidates(map, keyframe_id)) {
      const bool is_apart = map.keyframe(place).piece != map.keyframe(keyframe_id).piece;
      c.candidates.push_back({place, is_apart});
    }
    if (!c.candidates.empty()) c.keyframe = CopyKeyframe(map.keyframe(keyframe_id));
    return c;
  });
  for (const Candidate& candidate : current.candidates) {
    std::optional<Loop> loop = Close(current.keyframe, current.epoch, candidate);
    if (!loop) continue;
    detector_->LoopClosed(keyframe_id);
    loop->seconds = stopwatch.Seconds();
    return loop;
  }
  return std::nullopt;
}

// Nothing if the keyframe does not show the place, or the map was moved meanwhile: then the next
// keyframe will see it.
std::optional<LoopClosing::Loop> LoopClosing::Close(const KeyframeCopy& keyframe,
                                                    std::uint64_t epoch,
                                                    const Candidate& candidate) {
  const std::optional<TrackedFrame> located =
      locator_.Locate(keyframe.frame, *keyframe.words, candidate.place);
  if (!located) return std::nullopt;
  if (candidate.is_apart && located->NumLandmarks() < options_.min_matches_to_join) {
    return std::nullopt;
  }
  const LoopMatch match{keyframe.id, candidate.place, located->T_world_camera, epoch};
  const auto correct = candidate.is_apart ? JoinPieces : CorrectLoop;
  const std::optional<LoopCorrection> correction =
      correct(camera_, baseline_times_fx_, match,
              {options_.min_shared, options_.min_shared_essential, options_.min_hits_for_edge,
               options_.pose_graph},
              map_);
  if (!correction) return std::nullopt;
  const Rigid3& T_world_old = keyframe.T_world_camera;
  const Rigid3& T_world_new = located->T_world_camera;
  return Loop{.keyframe = keyframe.id,
              .place = candidate.place,
              .num_matches = located->NumLandmarks(),
              .num_fused = correction->num_fused,
              .distance = (T_world_old.translation - T_world_new.translation).norm(),
              .angle = RotationAngle(T_world_old, T_world_new),
              .joins_pieces = candidate.is_apart};
}

}  // namespace semslam

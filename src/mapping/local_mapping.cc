// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/mapping/local_mapping.h"

#include <algorithm>
#include <array>
#include <utility>

#include "semslam/base/check.h"
#include "semslam/base/stopwatch.h"
#include "semslam/mapping/appearance_update.h"

#include "mapping/keyframe_culling.h"
#include "mapping/landmark_fusion.h"
#include "mapping/local_bundle.h"
#include "mapping/mapping_context.h"
#include "mapping/triangulation.h"

namespace semslam {

void LocalMapping::Options::Validate() const {
  SEMSLAM_CHECK(close_depth_m > 0) << close_depth_m;
  SEMSLAM_CHECK(min_found_ratio >= 0 && min_found_ratio < 1) << min_found_ratio;
  SEMSLAM_CHECK(redundant_ratio > 0 && redundant_ratio <= 1) << redundant_ratio;
  SEMSLAM_CHECK(max_adjusted_keyframes >= 2) << max_adjusted_keyframes;
  bundle.Validate();
}

LocalMapping::LocalMapping(const Options& options,
                           const PinholeCamera& camera,
                           double baseline_times_fx,
                           std::shared_ptr<const Vocabulary> vocabulary,
                           SharedMap& map)
    : options_(options),
      camera_(camera),
      stereo_(MakeStereoCamera(camera, baseline_times_fx)),
      vocabulary_(std::move(vocabulary)),
      map_(map) {
  options_.Validate();
  SEMSLAM_CHECK(vocabulary_ != nullptr);
  map_.Write([&](Map& m) { m.ReserveWords(vocabulary_->num_words()); });
}

LocalMapping::Report LocalMapping::Process(KeyframeId keyframe,
                                           const std::function<bool()>& should_stop) {
  Stopwatch step;
  Report report;
  report.keyframe = keyframe;
  if (!LookUpWords(keyframe)) {
    report.is_void = true;
    return report;
  }
  const MappingContext context{camera_, stereo_, map_};
  WatchNewLandmarks(keyframe);
  report.num_landmarks_culled = CullRecentLandmarks(keyframe);
  const std::vector<LandmarkId> triangulated =
      TriangulateWithNeighbours(context, keyframe, options_.num_neighbours, should_stop);
  recent_landmarks_.insert(recent_landmarks_.end(), triangulated.begin(), triangulated.end());
  report.num_triangulated = static_cast<int>(triangulated.size());
  report.triangulate_seconds = step.Seconds();
  step.Restart();
  if (!should_stop()) {
    report.num_fused = FuseWithNeighbours(
        context, keyframe, {options_.num_neighbours, options_.num_second_neighbours});
  }
  UpdateAppearances(
      map_, map_.Read([&](const Map& map) { return map.LandmarksSeenBy(std::array{keyframe}); }));
  report.fuse_seconds = step.Seconds();
  step.Restart();
  if (!should_stop()) {
    const LocalBundleReport bundle = AdjustNeighbourhood(
        context, keyframe, {options_.min_shared, options_.max_adjusted_keyframes, options_.bundle},
        should_stop);
    report.adjusted = bundle.finished;
    report.adjust_seconds = step.Seconds();
    step.Restart();
    report.keyframes_culled = CullRedundantKeyframes(
        context, keyframe,
        {options_.close_depth_m, options_.redundant_ratio, options_.min_redundant_views});
    report.cull_seconds = step.Seconds();
  }
  return report;
}

// False if the keyframe is gone: the map was cleared since it was queued.
bool LocalMapping::LookUpWords(KeyframeId keyframe) {
  const std::shared_ptr<const Frame> frame = map_.Read([&](const Map& map) {
    const Keyframe* found = map.FindKeyframe(keyframe);
    return found == nullptr ? nullptr : found->frame;
  });
  if (!frame) return false;
  auto words = std::make_shared<const BagOfWords>(vocabulary_->Transform(frame->descriptors));
  return map_.Write([&](Map& map) {
    if (map.FindKeyframe(keyframe) == nullptr) return false;
    map.SetWords(keyframe, std::move(words));
    return true;
  });
}

// Landmarks that tracking made with this keyframe are on probation.
void LocalMapping::WatchNewLandmarks(KeyframeId keyframe) {
  map_.Read([&](const Map& map) {
    const Keyframe* found = map.FindKeyframe(keyframe);
    if (found == nullptr) return;
    for (const std::optional<LandmarkId> id : found->landmarks) {
      if (id && map.landmark(*id).first_keyframe == keyframe) recent_landmarks_.push_back(*id);
    }
  });
}

int LocalMapping::CullRecentLandmarks(KeyframeId current) {
  // How many keyframes a landmark is on probation, and after how many it must have been seen again.
  constexpr std::uint32_t kProbation = 3;
  constexpr std::uint32_t kMustBeSeenAgain = 2;
  std::vector<LandmarkId> bad;
  std::deque<LandmarkId> still_recent;
  map_.Read([&](const Map& map) {
    for (const LandmarkId id : recent_landmarks_) {
      const Landmark* landmark = map.FindLandmark(id);
      if (landmark == nullptr) continue;
      const std::uint32_t age = current.value - landmark->first_keyframe.value;
      if (landmark->num_found < options_.min_found_ratio * landmark->num_visible ||
          (age >= kMustBeSeenAgain &&
           landmark->num_measurements < options_.min_recent_measurements)) {
        bad.push_back(id);
      } else if (age < kProbation) {
        still_recent.push_back(id);
      }
    }
  });
  recent_landmarks_ = std::move(still_recent);
  constexpr std::size_t kNumPerLock = 32;
  for (std::size_t first = 0; first < bad.size(); first += kNumPerLock) {
    map_.Write([&](Map& map) {
      for (std::size_t i = first; i < std::min(bad.size(), first + kNumPerLock); ++i) {
        if (map.FindLandmark(bad[i]) != nullptr) map.EraseLandmark(bad[i]);
      }
    });
  }
  return static_cast<int>(bad.size());
}

}  // namespace semslam

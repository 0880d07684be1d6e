// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/tracking/keyframe_policy.h"

#include "semslam/base/check.h"

namespace semslam {

void KeyframePolicy::Options::Validate() const {
  SEMSLAM_CHECK(max_frames_between > 0) << max_frames_between;
  SEMSLAM_CHECK(max_queued > 0) << max_queued;
  SEMSLAM_CHECK(max_new_share > 0) << max_new_share;
  SEMSLAM_CHECK(weak_ratio >= 0 && weak_ratio <= changed_ratio && changed_ratio <= 1)
      << weak_ratio << ", " << changed_ratio;
}

KeyframePolicy::KeyframePolicy(const Options& options) : options_(options) { options.Validate(); }

bool KeyframePolicy::WantsKeyframe(const Situation& now) const {
  const double reference = now.num_reference_landmarks;
  const double changed_ratio =
      now.num_keyframes < 2 ? options_.changed_ratio_at_start : options_.changed_ratio;
  const bool needs_close_points = now.num_close_tracked < options_.enough_close_tracked &&
                                  now.num_close_untracked > options_.many_close_untracked;
  const bool is_time = now.num_frames_since_keyframe >= options_.max_frames_between;
  const bool is_weak = now.num_inliers < options_.weak_ratio * reference || needs_close_points;
  const bool has_changed = now.num_inliers < changed_ratio * reference || needs_close_points ||
                           now.new_share > options_.max_new_share;

  if (!(is_time || now.mapper.is_idle || is_weak)) return false;
  if (!has_changed || now.num_inliers <= options_.min_inliers) return false;
  return now.mapper.is_idle || now.mapper.num_queued < options_.max_queued;
}

}  // namespace semslam

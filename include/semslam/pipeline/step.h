// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <functional>

namespace semslam {

// What a run spends its time on.
enum class Step {
  // Of each frame, in the caller's thread.
  kFeatures,     // Pyramid, corners, descriptors, depth.
  kFirstPose,    // From the last frame, a keyframe, or found again.
  kLocalMap,     // Search for its landmarks, and the final pose.
  kNewKeyframe,  // Whether there is to be one, and its insertion.
  // Of each keyframe, in local mapping's thread.
  kTriangulation,  // With its words, and the culling of landmarks before it.
  kFusion,         // Of landmarks that are one, and their new appearance.
  kLocalBundle,    // Local bundle adjustment, with snapshot and commit.
  kCulling,        // Of keyframes.
  // In threads of their own.
  kLoop,        // Of each keyframe: is it at a known place, and the correction if so.
  kFullBundle,  // Of each run of it, also one that was broken off.
};

// Told of each step that was done, and how long it took, in the thread that did it: several call it
// at a time. Must not throw.
using StepObserver = std::function<void(Step step, double seconds)>;

}  // namespace semslam

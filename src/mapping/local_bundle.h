// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <functional>

#include "semslam/optim/bundle_adjuster.h"

#include "mapping/mapping_context.h"

namespace semslam {

struct LocalBundleOptions {
  int min_shared;             // Landmarks in common with the keyframe to be moved with it.
  std::size_t max_keyframes;  // Moved at most.
  BundleOptions bundle;
};

struct LocalBundleReport {
  bool finished = false;  // Not interrupted, and committed.
};

// Local bundle adjustment around a keyframe: it and its covisible keyframes move, with all
// landmarks they see; other keyframes that see these landmarks hold them in place. Observations
// that do not fit are removed.
LocalBundleReport AdjustNeighbourhood(const MappingContext& context,
                                      KeyframeId keyframe,
                                      const LocalBundleOptions& options,
                                      const std::function<bool()>& should_stop);

}  // namespace semslam

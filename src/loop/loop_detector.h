// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <vector>

#include "semslam/map/map.h"

namespace semslam {

struct LoopDetectorOptions {
  std::uint32_t min_keyframes_between;
  int num_consistent;
  int min_shared;
};

// Finds places that keyframe after keyframe looks like. What looks like a place once may do so by
// chance; what looks like neighbouring places several times in a row has come back, or is in a
// building of equal rooms: that, geometry must tell.
class LoopDetector {
 public:
  explicit LoopDetector(const LoopDetectorOptions& options) : options_(options) {}

  // The old keyframes that this one and those before it agree on, likeliest first. In another piece
  // of the map one keyframe alone will do: nothing else ties the two together, and the camera may
  // not come back.
  std::vector<KeyframeId> FindCandidates(const Map& map, KeyframeId keyframe);
  // No other loop for a while.
  void LoopClosed(KeyframeId keyframe);

 private:
  // Neighbouring keyframes that were pointed to, and for how many keyframes in a row.
  struct Group {
    std::vector<KeyframeId> members;  // Ascending.
    int length = 1;
  };
  int LengthOfChain(const std::vector<KeyframeId>& members) const;

  const LoopDetectorOptions options_;
  std::vector<Group> previous_;
  std::optional<KeyframeId> last_loop_;
};

}  // namespace semslam

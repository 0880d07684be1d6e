// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "semslam/camera/pinhole_camera.h"
#include "semslam/map/map.h"
#include "semslam/optim/pose_graph.h"
#include "semslam/place/vocabulary.h"
#include "semslam/tracking/frame_locator.h"

namespace semslam {

class LoopDetector;

// Notices that the camera has come back to a place it knows, and corrects the drift that it
// gathered on the way (Mur-Artal, Montiel, Tardos, "ORB-SLAM", 2015, section VII; with depth the
// scale is known, so the correction is rigid: "ORB-SLAM2", 2017). One thread at a time. It works
// on copies and commits the whole correction at once, in a new epoch of the map: tracking and local
// mapping go on meanwhile, and drop what they computed from the old one.
class LoopClosing {
 public:
  struct Options {
    std::uint32_t min_keyframes_between = 10;  // Since the last loop, by their ids.
    int num_consistent = 3;  // Keyframes in a row that must point to the same place.
    int min_shared = 15;     // Landmarks in common to be one group.
    // The essential graph: the spanning tree, the loops, and pairs that share so many landmarks.
    int min_shared_essential = 100;
    int min_hits_for_edge = 30;    // Loop landmarks a keyframe must show to get a loop edge itself.
    int min_matches_to_join = 50;  // Landmarks that must agree to join two pieces of the map.
    FrameLocator::Options locator{.min_word_matches = 20,
                                  .min_pose_inliers = 20,
                                  .min_inliers = 40,
                                  .num_neighbours = 20,
                                  .ransac = {.min_inliers = 20}};
    PoseGraphOptions pose_graph;
    void Validate() const;  // Throws std::logic_error.
  };

  // A loop that was closed, or two pieces of the map that were joined.
  struct Loop {
    KeyframeId keyframe;        // That recognised the place,
    KeyframeId place;           // and an old keyframe there.
    int num_matches = 0;        // Of its landmarks that agree with the pose.
    int num_fused = 0;          // Landmarks that were merged or seen again around it.
    double distance = 0;        // Metres that the keyframe was off,
    double angle = 0;           // and radians.
    bool joins_pieces = false;  // Then there was no common frame in which to be off.
    double seconds = 0;
  };

  LoopClosing(const Options& options,
              const PinholeCamera& camera,
              double baseline_times_fx,
              std::shared_ptr<const Vocabulary> vocabulary,
              SharedMap& map);
  ~LoopClosing();

  // Of keyframes that local mapping is done with, in their order.
  std::optional<Loop> Process(KeyframeId keyframe);

 private:
  struct Candidate;
  std::optional<Loop> Close(const KeyframeCopy& keyframe,
                            std::uint64_t epoch,
                            const Candidate& candidate);

  const Options options_;
  const PinholeCamera camera_;
  const double baseline_times_fx_;
  SharedMap& map_;
  const FrameLocator locator_;
  std::unique_ptr<LoopDetector> detector_;
};

}  // namespace semslam

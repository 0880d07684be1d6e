// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "semslam/camera/pinhole_camera.h"
#include "semslam/map/map.h"
#include "semslam/optim/bundle_adjuster.h"
#include "semslam/optim/camera_model.h"
#include "semslam/place/vocabulary.h"

namespace semslam {

// Works a new keyframe into the map (Mur-Artal, Montiel, Tardos, "ORB-SLAM", 2015, section VI):
// drops recent landmarks that proved bad, triangulates new ones, fuses duplicates, adjusts the
// neighbourhood, drops redundant keyframes. One thread at a time. Slow work runs on copies; the map
// is locked for short reads and commits only.
class LocalMapping {
 public:
  struct Options {
    double close_depth_m = 3.1;       // See Tracking: redundancy is judged on close landmarks.
    std::size_t num_neighbours = 10;  // Covisible keyframes to triangulate and fuse with.
    std::size_t num_second_neighbours = 5;  // Theirs, to fuse with.
    int min_shared = 15;                    // Landmarks in common to count as covisible.
    double min_found_ratio =
        0.25;  // Recent landmarks found in fewer of the frames that should show them go.
    int min_recent_measurements =
        4;  // Those with fewer, two keyframes after they were made, go too.
    double redundant_ratio =
        0.9;  // Of a keyframe's close landmarks that others see as well: it goes.
    int min_redundant_views = 3;  // Others that must see each of them.
    std::size_t max_adjusted_keyframes =
        40;                 // In the local bundle adjustment: the best neighbours.
    BundleOptions bundle;   // Its should_stop is set by Process.
    void Validate() const;  // Throws std::logic_error.
  };

  struct Report {
    KeyframeId keyframe;
    bool is_void = false;  // The map was cleared meanwhile; nothing was done.
    int num_triangulated = 0;
    int num_fused = 0;
    int num_landmarks_culled = 0;
    std::vector<KeyframeId> keyframes_culled;
    bool adjusted = false;  // The bundle adjustment ran to its end.
    // Spent on each step; 0 for one that was skipped.
    double triangulate_seconds = 0;  // With words and the culling of landmarks before it.
    double fuse_seconds = 0;         // With new appearances.
    double adjust_seconds = 0;       // The bundle adjustment with snapshot and commit.
    double cull_seconds = 0;         // Of keyframes.
  };

  LocalMapping(const Options& options,
               const PinholeCamera& camera,
               double baseline_times_fx,
               std::shared_ptr<const Vocabulary> vocabulary,
               SharedMap& map);

  // `should_stop` is asked now and then: true (a newer keyframe waits) skips what can wait, fusion
  // with neighbours and bundle adjustment.
  Report Process(KeyframeId keyframe, const std::function<bool()>& should_stop);

 private:
  bool LookUpWords(KeyframeId keyframe);
  int CullRecentLandmarks(KeyframeId current);
  void WatchNewLandmarks(KeyframeId keyframe);

  const Options options_;
  const PinholeCamera camera_;
  const StereoCamera stereo_;
  const std::shared_ptr<const Vocabulary> vocabulary_;
  SharedMap& map_;
  std::deque<LandmarkId> recent_landmarks_;  // On probation.
};

}  // namespace semslam

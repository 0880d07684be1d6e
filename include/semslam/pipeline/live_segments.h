// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "semslam/base/guarded.h"
#include "semslam/dense/voxel_map.h"
#include "semslam/segmentation/live_segmenter.h"

namespace semslam {

// The map while it grows, with its segments; immutable.
struct SegmentedCloud {
  MapCloud cloud;
  std::vector<SegmentId> segment_of_point;  // 0: none yet. Ids stay from one map to the next.
};

// Keeps the segments of a voxel map in step with it: after every keyframe, or several of them, the
// region that has changed most is segmented again, after a correction all that has moved. Belongs
// to the thread of the voxel map, but for RequestMap and map.
class LiveSegments {
 public:
  struct Options {
    bool enabled = true;
    std::size_t max_voxels = LiveSegmenter::Options().max_voxels;  // Segmented for a keyframe.
    // In the background, so that tracking keeps its core; 0: as many as there are cores.
    int num_threads = 1;
    void Validate() const;  // Throws InputError.
  };

  // Of the time that following the keyframes took; corrections are not among them.
  struct Statistics {
    std::size_t num_keyframes = 0;
    std::size_t num_segments = 0;
    double mean_milliseconds = 0;         // A keyframe.
    double max_milliseconds = 0;          // Of one keyframe.
    double first_half_milliseconds = 0;   // Mean of the first half of the keyframes,
    double second_half_milliseconds = 0;  // and of the second.
  };

  // Segments with `segmentation`, but on the threads of `options`. The voxel map must outlive this.
  LiveSegments(const Options& options, const Segmenter::Options& segmentation, VoxelMap* voxel_map);

  void Follow();
  void FollowCorrection();

  // Any thread: asks for a map, which is made after the next keyframe or correction.
  void RequestMap();
  // The newest one that was asked for; null before the first.
  std::shared_ptr<const SegmentedCloud> map() const;

  Statistics statistics() const;
  // The segments as they are now.
  SegmentedCloud MakeMap() const;

 private:
  struct Published {
    bool is_requested = false;
    std::shared_ptr<const SegmentedCloud> map;
  };

  void TakeChanges();
  void SegmentRegion(const LiveSegmenter::Region& region);
  void PublishIfAsked();

  const Options options_;
  VoxelMap* const voxel_map_;
  LiveSegmenter segmenter_;
  std::vector<double> milliseconds_;  // By keyframe.
  Guarded<Published> published_;
};

}  // namespace semslam

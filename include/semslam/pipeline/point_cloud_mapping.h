// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "semslam/base/binary_stream.h"
#include "semslam/base/guarded.h"
#include "semslam/base/id.h"
#include "semslam/base/stage.h"
#include "semslam/camera/pinhole_camera.h"
#include "semslam/camera/rgbd_image.h"
#include "semslam/dense/keyframe_cloud.h"
#include "semslam/dense/voxel_map.h"
#include "semslam/geometry/rigid3.h"
#include "semslam/pipeline/live_segments.h"
#include "semslam/segmentation/segmenter.h"
#include "semslam/semantics/semantic_map.h"

namespace semslam {

// Builds the dense map from keyframes in a thread of its own, keeps it in step with the keyframes'
// poses, segments it and puts the detector's labels on the segments (paper, sections 3.1 to 3.3).
class PointCloudMapping {
 public:
  struct Options {
    KeyframeCloud::Options cloud;
    VoxelMap::Options voxels;
    Segmenter::Options segmentation;
    LiveSegments::Options live;
    FusionOptions fusion;
    std::size_t queue_capacity =
        32;  // Keyframes and detections waiting; the producer of more waits.
    void Validate() const;
  };

  // Where keyframes are. Those no longer in the map (it was cleared) are in neither.
  struct Places {
    std::map<KeyframeId, Rigid3> T_world_camera;
    std::set<KeyframeId> apart;  // In the map, but how they lie to the world is not known yet.
  };
  // Called from this class's thread.
  using PlaceLookup = std::function<Places(const std::vector<KeyframeId>&)>;

  struct Result {
    MapCloud cloud;
    Segmentation segmentation;
    SemanticMap semantics;
    double integration_milliseconds = 0;  // Mean, a keyframe.
    LiveSegments::Statistics live;
    double segmentation_milliseconds = 0;  // Of the final pass.
    double fusion_milliseconds = 0;        // Of the final pass.
  };

  PointCloudMapping(Threading threading,
                    const Options& options,
                    const PinholeCamera& camera,
                    ClassTable classes,
                    PlaceLookup look_up);

  // False once finished or failed.
  bool InsertKeyframe(KeyframeId keyframe, RgbdImagePtr image);
  // Keyframes have moved: the map follows now, not only with the next keyframe. Never waits; if the
  // queue is full, a keyframe comes soon anyway.
  void FollowCorrection();
  bool InsertDetections(KeyframeId keyframe, std::vector<Detection> detections);

  // All that a map file has to keep: the keyframes' clouds and what was detected in them. Only once
  // finished.
  void Write(BinaryWriter* writer) const;
  // Goes on from what Write wrote; before anything is inserted. The keyframes' poses are looked up.
  // Of a map with other classes than the detector's the detections are dropped: returns false.
  // Throws InputError if the bytes are damaged.
  bool Restore(BinaryReader* reader);

  // Works off what is queued, ends the thread, brings the map to the keyframes' final poses and
  // labels it. Rethrows what the thread threw.
  Result Finish();

  // --- For those who watch while it runs, from any thread.
  // What the keyframes saw, ascending by id, in the frames of the keyframes.
  std::vector<std::shared_ptr<const KeyframeCloud>> clouds() const;
  // The map as it is, segmented and labelled, as soon as little else waits; in the background, and
  // never with Threading::kInline. An object keeps its id from one preview to the next.
  void RequestPreview();
  // The newest one; null before the first.
  std::shared_ptr<const Result> preview() const;
  // The map with its segments, as of some keyframe ago: see LiveSegments. Any thread may call both.
  void RequestLiveMap() { live_segments_.RequestMap(); }
  std::shared_ptr<const SegmentedCloud> live_map() const { return live_segments_.map(); }

  std::size_t queue_size() const { return stage_.queue_size(); }
  std::size_t num_voxels() const {
    return num_voxels_.Read([](std::size_t n) { return n; });
  }

 private:
  // One of these things to do; its other fields are empty.
  struct Job {
    enum class Kind { kKeyframe, kDetections, kCorrection, kPreview };
    Kind kind;
    KeyframeId keyframe = {};
    RgbdImagePtr image = nullptr;
    std::vector<Detection> detections = {};
  };

  // How much of the map the live segments have not followed yet.
  enum class Lag { kNone, kKeyframe, kMap };

  // What may be looked at while it runs.
  struct Sight {
    std::map<KeyframeId, std::shared_ptr<const KeyframeCloud>> clouds;
    std::shared_ptr<const Result> preview;
    bool preview_is_wanted = false;
  };

  void Process(Job job);
  void Do(Job job);
  void ShowPreview();
  Result Build(const Segmenter::Options& segmentation, const SemanticMap* previous) const;
  void Integrate(KeyframeId keyframe, const RgbdImage& image);
  void FollowWithSegments();
  void FollowPoses(double max_shift);
  std::vector<LabelledKeyframe> LabelledKeyframes() const;

  const Options options_;
  const Threading threading_;
  const std::shared_ptr<const RayTable> rays_;
  ClassTable classes_;
  const PlaceLookup look_up_;
  // The stage's own, until it has finished.
  VoxelMap voxel_map_;
  LiveSegments live_segments_;
  Lag segments_lag_ = Lag::kNone;
  std::map<KeyframeId, std::shared_ptr<const KeyframeCloud>> clouds_;
  std::map<KeyframeId, std::vector<Detection>> detections_;
  // What made the newest preview.
  std::uint64_t num_changes_ = 1;
  std::uint64_t num_changes_shown_ = 0;
  double integration_seconds_ = 0;
  std::size_t num_integrated_ = 0;

  Guarded<std::size_t> num_voxels_{0};
  Guarded<Sight> sight_;
  Stage<Job> stage_;  // Last: its thread ends before what it uses.
};

}  // namespace semslam

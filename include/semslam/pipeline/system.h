// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "semslam/base/binary_stream.h"
#include "semslam/base/guarded.h"
#include "semslam/base/log.h"
#include "semslam/base/stage.h"
#include "semslam/base/time.h"
#include "semslam/camera/pinhole_camera.h"
#include "semslam/camera/rgbd_image.h"
#include "semslam/config/settings.h"
#include "semslam/features/frame_builder.h"
#include "semslam/loop/loop_closing.h"
#include "semslam/map/map.h"
#include "semslam/mapping/local_mapping.h"
#include "semslam/pipeline/detector_thread.h"
#include "semslam/pipeline/point_cloud_mapping.h"
#include "semslam/pipeline/step.h"
#include "semslam/place/vocabulary.h"
#include "semslam/semantics/detector.h"
#include "semslam/tracking/tracking.h"

namespace semslam {

// The whole: tracking in the caller's thread, local mapping, loop closing, the bundle adjustment
// after a loop, dense mapping and the detector each in its own (or all in the caller's, with
// Threading::kInline: then the same input gives the same bytes).
//
//   System system(settings, vocabulary, {});
//   while (auto image = source.Next()) {
//     system.TrackRGBD(std::make_shared<const RgbdImage>(*std::move(image)));
//   }
//   const PointCloudMapping::Result map = system.Shutdown();
//
// TrackRGBD and Shutdown belong to one thread; the const methods may be called from any.
class System {
 public:
  struct Options {
    Threading threading = Threading::kWorkers;
    std::unique_ptr<Detector> detector;  // Null: geometry and segments only.
    LogSink log;                         // May be empty.
    // Finds the camera in a loaded map, and leaves the map as it is.
    bool localization_only = false;
    // For measurements; both may be empty.
    StepObserver on_step = {};
    SharedMap::WaitObserver on_map_wait = {};
  };

  // What can be watched while it runs.
  struct Status {
    std::size_t num_keyframes = 0;
    std::size_t num_landmarks = 0;
    std::size_t num_voxels = 0;
    std::size_t num_relocalizations = 0;  // Losses after which the place was found again.
    std::size_t num_loops = 0;            // Closed.
    std::size_t num_joins = 0;            // Pieces of the map that were joined to others.
    std::size_t num_pieces = 0;           // Of the map, now.
    double readout_seconds = 0;           // Of the rolling shutter: see RollingShutter.
    std::size_t num_full_bundles = 0;  // Bundle adjustments of the whole map that ran to the end.
    bool mapping_is_idle = true;       // Local mapping has nothing queued and nothing in hand.
    std::size_t mapping_queue = 0;
    std::size_t loop_queue = 0;
    std::size_t dense_queue = 0;
    std::size_t detector_queue = 0;
  };

  // The keyframes and what ties them, as the map knows them now. Edges are pairs of places in
  // `keyframes`.
  struct Graph {
    struct Node {
      KeyframeId id;
      TimeNs time = 0;
      Rigid3 T_world_camera;
    };
    using Edge = std::pair<std::size_t, std::size_t>;
    std::vector<Node> keyframes;  // Ascending by id.
    std::vector<Edge> tree;       // Each keyframe with its parent.
    std::vector<Edge> covisible;  // With at least so many common landmarks as were asked for.
    std::vector<Edge> loops;      // Closed.
  };

  struct TrackedPose {
    TimeNs time = 0;
    Rigid3 T_world_camera;
  };

  // Throws InputError for settings that make no sense.
  System(const Settings& settings,
         const std::shared_ptr<const Vocabulary>& vocabulary,
         Options options);
  ~System();
  System(const System&) = delete;
  System& operator=(const System&) = delete;

  // Frames in the order of time; one that is not newer than the frame before is skipped. An image
  // of the wrong size or type throws std::logic_error. Rethrows what a thread threw.
  Tracking::Result TrackRGBD(const RgbdImagePtr& image);

  // Between two frames, in the thread of TrackRGBD: forgets map and trajectory, and the next frame
  // may be the first.
  void Reset();
  // The same: only find the camera in the map, which stays as it is; or map again.
  void SetLocalizationOnly(bool localization_only);

  // Images that still wait for the detector when the run ends: all are looked at, or only the one
  // in hand; and in a hurry the bundle adjustment after a loop is broken off too.
  enum class PendingLabels { kFinish, kDrop, kDropAndBreakOff };

  // Lets every thread finish what is queued, but for what `pending` says, and returns the final
  // dense, segmented and labelled map. Call it once; the trajectories stay available. Without it,
  // the destructor ends the threads and drops what is queued.
  PointCloudMapping::Result Shutdown(PendingLabels pending = PendingLabels::kFinish);

  // Writes everything that a later run needs to go on, in one file, complete or not at all. After
  // Shutdown; in any state, also while lost. Throws InputError if it cannot be written.
  void SaveMap(const std::filesystem::path& path) const;
  // Goes on from a map that SaveMap wrote: before the first frame, which is then looked for in the
  // map. Shut down without any frame, it gives the results of the run that saved it, to the byte;
  // with frames, the camera's trajectory is that of the new frames. Throws InputError if the file
  // is damaged, or was made with another camera or image pyramid.
  void LoadMap(const std::filesystem::path& path);
  // The settings with which a map file was made. Throws InputError if there are none in it.
  static Settings ReadMapSettings(const std::filesystem::path& path);

  // Poses of all frames that were tracked, and of all keyframes, as the map knows them now: those
  // in its main piece, see Map::MainPiece.
  std::vector<TrackedPose> CameraTrajectory() const;
  std::vector<TrackedPose> KeyframeTrajectory() const;

  Status status() const;
  Graph graph(int min_shared = 100) const;
  // Also of keyframes that were culled; those that are no longer known (the map was cleared) are
  // missing.
  std::map<KeyframeId, Rigid3> KeyframePoses(const std::vector<KeyframeId>& ids) const;
  // The dense map while it grows: see PointCloudMapping.
  std::vector<std::shared_ptr<const KeyframeCloud>> clouds() const {
    return point_cloud_mapping_.clouds();
  }
  void RequestPreview() { point_cloud_mapping_.RequestPreview(); }
  std::shared_ptr<const PointCloudMapping::Result> preview() const {
    return point_cloud_mapping_.preview();
  }
  DetectorThread::Statistics detector_statistics() const;
  bool has_detector() const { return detector_ != nullptr; }

 private:
  struct KeyframeJob {
    KeyframeId keyframe;
    RgbdImagePtr image;
  };
  // A frame's pose relative to a keyframe, so that it follows every correction.
  struct TrajectoryEntry {
    TimeNs time = 0;
    KeyframeId reference;
    Rigid3 T_reference_camera;
  };

  Tracking::Result Skipped(const RgbdImage& image) const;
  struct FullBundleJob {};
  struct Events {
    std::size_t num_relocalizations = 0;
    std::size_t num_full_bundles = 0;
    double readout_seconds = 0;
    std::vector<LoopClosing::Loop> loops;
  };

  void WriteTrajectory(BinaryWriter* writer) const;
  void ReadTrajectory(BinaryReader* reader);
  void MapKeyframe(const KeyframeJob& job);
  void CloseLoop(KeyframeId keyframe);
  void AdjustAll();
  void RethrowFailures();
  void TellOfLosses(const Tracking::Result& result);
  void LogNewLoops();
  PointCloudMapping::Places LookUpPlaces(const std::vector<KeyframeId>& ids) const;
  void Log(LogLevel level, const std::string& message) const;
  void Tell(Step step, double seconds) const;

  const LogSink log_;
  const StepObserver on_step_;
  const std::string settings_text_;
  const PinholeCamera camera_;
  const std::shared_ptr<const Vocabulary> vocabulary_;
  const StereoCamera stereo_;
  const LoopSettings loop_settings_;
  const FrameBuilder frame_builder_;
  SharedMap map_;
  Tracking tracking_;
  LocalMapping local_mapping_;
  LoopClosing loop_closing_;
  std::stop_source break_off_;  // The bundle adjustment of the whole map.
  Guarded<Events> events_;
  std::size_t num_loops_logged_ = 0;
  std::optional<TimeNs> last_time_;    // Of the newest frame.
  bool trajectory_is_loaded_ = false;  // From a map file, until the first frame.
  bool is_shut_down_ = false;
  Guarded<std::vector<TrajectoryEntry>> trajectory_;
  // Each stage after those it feeds, so that the feeder ends first.
  PointCloudMapping point_cloud_mapping_;
  std::unique_ptr<DetectorThread> detector_;
  Stage<FullBundleJob> full_bundle_stage_;
  Stage<KeyframeId> loop_stage_;
  Stage<KeyframeJob> mapping_stage_;
};

}  // namespace semslam

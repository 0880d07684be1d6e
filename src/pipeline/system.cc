// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/pipeline/system.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>
#include <utility>

#include "semslam/base/check.h"
#include "semslam/base/stopwatch.h"
#include "semslam/mapping/full_bundle.h"

namespace semslam {
namespace {

// More than the keyframe policy ever lets wait, so that tracking never does.
constexpr std::size_t kMappingQueueCapacity = 16;
// Loop closing is faster than keyframes come, but while it closes one.
constexpr std::size_t kLoopQueueCapacity = 64;

Tracking::Options TrackingOptions(const Settings& settings, bool localization_only) {
  Tracking::Options options = settings.tracking;
  options.close_depth_m = settings.CloseDepth();
  options.localization_only = localization_only;
  options.keyframes.max_frames_between = std::max(1, static_cast<int>(std::lround(settings.fps)));
  return options;
}

LocalMapping::Options MappingOptions(const Settings& settings) {
  LocalMapping::Options options = settings.mapping;
  options.close_depth_m = settings.CloseDepth();
  return options;
}

PointCloudMapping::Options PointCloudOptions(const Settings& settings) {
  PointCloudMapping::Options options;
  options.cloud = settings.cloud;
  options.voxels = settings.voxels;
  options.segmentation = settings.segmentation;
  options.fusion = settings.fusion;
  return options;
}

}  // namespace

System::System(const Settings& settings,
               const std::shared_ptr<const Vocabulary>& vocabulary,
               Options options)
    : log_(std::move(options.log)),
      on_step_(std::move(options.on_step)),
      settings_text_(settings.text),
      camera_(settings.camera),
      vocabulary_(vocabulary),
      stereo_(MakeStereoCamera(camera_, settings.bf)),
      loop_settings_(settings.loop),
      frame_builder_(settings.orb, camera_, settings.bf),
      map_(ScaleSpace{settings.orb.scale_factor, settings.orb.num_levels}),
      tracking_(TrackingOptions(settings, options.localization_only),
                camera_,
                settings.bf,
                vocabulary,
                map_),
      local_mapping_(MappingOptions(settings), camera_, settings.bf, vocabulary, map_),
      loop_closing_(settings.loop.closing, camera_, settings.bf, vocabulary, map_),
      point_cloud_mapping_(
          options.threading,
          PointCloudOptions(settings),
          camera_,
          options.detector ? options.detector->classes() : ClassTable(),
          [this](const std::vector<KeyframeId>& ids) { return LookUpPlaces(ids); }),
      detector_(options.detector
                    ? std::make_unique<DetectorThread>(
                          options.threading,
                          std::move(options.detector),
                          [this](KeyframeId keyframe, std::vector<Detection> detections) {
                            point_cloud_mapping_.InsertDetections(keyframe, std::move(detections));
                          })
                    : nullptr),
      // One job waits at most: it takes the map as it is when it begins.
      full_bundle_stage_(
          {.threading = options.threading, .queue_capacity = 1, .is_background = true},
          [this](FullBundleJob) { AdjustAll(); }),
      loop_stage_({.threading = options.threading, .queue_capacity = kLoopQueueCapacity},
                  [this](KeyframeId keyframe) { CloseLoop(keyframe); }),
      mapping_stage_({.threading = options.threading, .queue_capacity = kMappingQueueCapacity},
                     [this](const KeyframeJob& job) { MapKeyframe(job); }) {
  map_.ObserveWaits(std::move(options.on_map_wait));  // The threads have nothing to do yet.
}

System::~System() {
  mapping_stage_.Cancel();
  loop_stage_.Cancel();
  break_off_.request_stop();
  full_bundle_stage_.Cancel();
  if (detector_) detector_->Cancel();
}

Tracking::Result System::TrackRGBD(const RgbdImagePtr& image) {
  SEMSLAM_CHECK(image != nullptr);
  RethrowFailures();
  LogNewLoops();
  if (last_time_ && image->time <= *last_time_) return Skipped(*image);
  const Stopwatch features;
  auto frame = std::make_shared<const Frame>(frame_builder_.Build(*image));
  Tell(Step::kFeatures, features.Seconds());
  const MapperLoad load{mapping_stage_.idle(), static_cast<int>(mapping_stage_.queue_size())};
  Tracking::Result result = tracking_.Track(std::move(frame), load);
  Tell(Step::kFirstPose, result.first_pose_seconds);
  Tell(Step::kLocalMap, result.local_map_seconds);
  Tell(Step::kNewKeyframe, result.keyframe_seconds);
  if (std::exchange(trajectory_is_loaded_, false)) trajectory_.Write([](auto& e) { e.clear(); });
  last_time_ = image->time;
  TellOfLosses(result);
  if (result.state == TrackingState::kTracking) {
    trajectory_.Write([&](std::vector<TrajectoryEntry>& entries) {
      if (result.map_was_reset) entries.clear();
      entries.push_back({image->time, result.reference_keyframe, result.T_reference_camera});
    });
  }
  if (!result.new_keyframe) return result;
  events_.Write([&](Events& e) { e.readout_seconds = tracking_.readout_seconds(); });
  if (!mapping_stage_.Submit({*result.new_keyframe, image})) {
    mapping_stage_.Finish();  // It failed: tell why.
  }
  return result;
}

void System::TellOfLosses(const Tracking::Result& result) {
  if (result.map_was_reset) Log(LogLevel::kWarning, "tracking was lost at the start: map cleared");
  if (result.piece_was_started) {
    Log(LogLevel::kWarning,
        "tracking was lost and the place is new: another piece of the map begins");
  }
  if (result.relocalized) events_.Write([](Events& e) { ++e.num_relocalizations; });
}

void System::Reset() {
  tracking_.StartOver();
  trajectory_.Write([](std::vector<TrajectoryEntry>& entries) { entries.clear(); });
  trajectory_is_loaded_ = false;
  LogNewLoops();
  events_.Write([](Events& e) { e = {}; });
  num_loops_logged_ = 0;
  point_cloud_mapping_.FollowCorrection();
}

void System::SetLocalizationOnly(bool localization_only) {
  tracking_.SetLocalizationOnly(localization_only);
}

// A repeated frame, or one that was overtaken on its way: trajectories are in the order of time.
Tracking::Result System::Skipped(const RgbdImage& image) const {
  Log(LogLevel::kWarning, "frame skipped: expected a time after " + FormatTime(*last_time_) +
                              ", found " + FormatTime(image.time));
  Tracking::Result result;
  result.state = tracking_.state();
  result.was_skipped = true;
  return result;
}

void System::MapKeyframe(const KeyframeJob& job) {
  const auto newer_waits = [this] { return mapping_stage_.queue_size() > 0; };
  const LocalMapping::Report report = local_mapping_.Process(job.keyframe, newer_waits);
  if (report.is_void) return;
  Tell(Step::kTriangulation, report.triangulate_seconds);
  Tell(Step::kFusion, report.fuse_seconds);
  if (report.adjust_seconds > 0) Tell(Step::kLocalBundle, report.adjust_seconds);
  if (report.cull_seconds > 0) Tell(Step::kCulling, report.cull_seconds);
  if (loop_settings_.enabled) loop_stage_.Submit(job.keyframe);
  point_cloud_mapping_.InsertKeyframe(job.keyframe, job.image);
  if (detector_) detector_->Submit(job.keyframe, job.image);
}

void System::CloseLoop(KeyframeId keyframe) {
  const Stopwatch stopwatch;
  const std::optional<LoopClosing::Loop> loop = loop_closing_.Process(keyframe);
  Tell(Step::kLoop, stopwatch.Seconds());
  if (!loop) return;
  events_.Write([&](Events& e) { e.loops.push_back(*loop); });
  point_cloud_mapping_.FollowCorrection();
  full_bundle_stage_.TrySubmit({});
}

// A loop that is closed meanwhile begins a new epoch of the map, which ends this one without a
// result.
void System::AdjustAll() {
  BundleOptions options = loop_settings_.bundle;
  options.should_stop = [token = break_off_.get_token()] { return token.stop_requested(); };
  const Stopwatch stopwatch;
  const bool finished = AdjustWholeMap(map_, stereo_, options).finished;
  Tell(Step::kFullBundle, stopwatch.Seconds());
  if (!finished) return;
  events_.Write([](Events& e) { ++e.num_full_bundles; });
  point_cloud_mapping_.FollowCorrection();
}

void System::RethrowFailures() {
  if (loop_stage_.failed()) loop_stage_.Finish();
  if (full_bundle_stage_.failed()) full_bundle_stage_.Finish();
}

void System::LogNewLoops() {
  const std::vector<LoopClosing::Loop> loops = events_.Read([this](const Events& e) {
    return std::vector(e.loops.begin() + static_cast<std::ptrdiff_t>(num_loops_logged_),
                       e.loops.end());
  });
  num_loops_logged_ += loops.size();
  for (const LoopClosing::Loop& loop : loops) {
    std::ostringstream text;
    text << (loop.joins_pieces ? "pieces of the map joined" : "loop closed") << ": keyframe "
         << loop.keyframe.value << " is at keyframe " << loop.place.value << ", ";
    if (!loop.joins_pieces)
      text << "was off by " << std::fixed << std::setprecision(3) << loop.distance << " m; ";
    text << loop.num_matches << " matches, " << loop.num_fused << " landmarks fused";
    Log(LogLevel::kInfo, text.str());
  }
}

PointCloudMapping::Result System::Shutdown(PendingLabels pending) {
  mapping_stage_.Finish();
  loop_stage_.Finish();
  if (pending == PendingLabels::kDropAndBreakOff) break_off_.request_stop();
  full_bundle_stage_.Finish();
  if (loop_settings_.final_bundle) AdjustAll();
  LogNewLoops();
  if (detector_) {
    pending == PendingLabels::kFinish ? detector_->Finish() : detector_->Cancel();
  }
  is_shut_down_ = true;
  return point_cloud_mapping_.Finish();
}

std::map<KeyframeId, Rigid3> System::KeyframePoses(const std::vector<KeyframeId>& ids) const {
  return LookUpPlaces(ids).T_world_camera;
}

PointCloudMapping::Places System::LookUpPlaces(const std::vector<KeyframeId>& ids) const {
  return map_.Read([&](const Map& map) {
    const std::optional<KeyframeId> main = map.MainPiece();
    PointCloudMapping::Places places;
    for (const KeyframeId id : ids) {
      const std::optional<Rigid3> pose = map.ResolvePose(id);
      if (!pose) continue;
      if (map.PieceOf(id) == main) {
        places.T_world_camera[id] = *pose;
      } else {
        places.apart.insert(id);
      }
    }
    return places;
  });
}

std::vector<System::TrackedPose> System::CameraTrajectory() const {
  const auto entries = trajectory_.Read([](const std::vector<TrajectoryEntry>& e) { return e; });
  return map_.Read([&](const Map& map) {
    const std::optional<KeyframeId> main = map.MainPiece();
    std::vector<TrackedPose> poses;
    for (const TrajectoryEntry& entry : entries) {
      const std::optional<Rigid3> T_world_reference = map.ResolvePose(entry.reference);
      if (T_world_reference && map.PieceOf(entry.reference) == main)
        poses.push_back({entry.time, *T_world_reference * entry.T_reference_camera});
    }
    return poses;
  });
}

std::vector<System::TrackedPose> System::KeyframeTrajectory() const {
  return map_.Read([](const Map& map) {
    const std::optional<KeyframeId> main = map.MainPiece();
    std::vector<TrackedPose> poses;
    for (const KeyframeId id : map.KeyframeIds()) {
      const Keyframe& keyframe = map.keyframe(id);
      if (keyframe.piece != main) continue;
      poses.push_back({keyframe.frame->time, keyframe.T_world_camera});
    }
    // A map may be made of several recordings, of any order.
    std::stable_sort(poses.begin(), poses.end(),
                     [](const TrackedPose& a, const TrackedPose& b) { return a.time < b.time; });
    return poses;
  });
}

System::Status System::status() const {
  Status status;
  map_.Read([&](const Map& map) {
    status.num_keyframes = map.num_keyframes();
    status.num_landmarks = map.num_landmarks();
    status.num_pieces = map.pieces().size();
  });
  events_.Read([&](const Events& e) {
    status.num_relocalizations = e.num_relocalizations;
    status.num_joins = static_cast<std::size_t>(std::count_if(
        e.loops.begin(), e.loops.end(), [](const auto& l) { return l.joins_pieces; }));
    status.num_loops = e.loops.size() - status.num_joins;
    status.num_full_bundles = e.num_full_bundles;
    status.readout_seconds = e.readout_seconds;
  });
  status.num_voxels = point_cloud_mapping_.num_voxels();
  status.mapping_is_idle = mapping_stage_.idle();
  status.mapping_queue = mapping_stage_.queue_size();
  status.loop_queue = loop_stage_.queue_size();
  status.dense_queue = point_cloud_mapping_.queue_size();
  status.detector_queue = detector_ ? detector_->queue_size() : 0;
  return status;
}

System::Graph System::graph(int min_shared) const {
  const auto loops = events_.Read([](const Events& e) { return e.loops; });
  return map_.Read([&](const Map& map) {
    Graph graph;
    std::map<KeyframeId, std::size_t> place;
    for (const KeyframeId id : map.KeyframeIds()) {
      const Keyframe& keyframe = map.keyframe(id);
      place[id] = graph.keyframes.size();
      graph.keyframes.push_back({id, keyframe.frame->time, keyframe.T_world_camera});
    }
    const auto add = [&place](KeyframeId a, KeyframeId b, std::vector<Graph::Edge>* edges) {
      if (place.contains(a) && place.contains(b)) edges->emplace_back(place.at(a), place.at(b));
    };
    for (const auto& [id, index] : place) {
      const Keyframe& keyframe = map.keyframe(id);
      if (keyframe.parent) add(id, *keyframe.parent, &graph.tree);
      for (const CovisibleKeyframe& other : keyframe.covisible) {
        if (other.id < id && other.num_shared >= min_shared) add(id, other.id, &graph.covisible);
      }
    }
    for (const LoopClosing::Loop& loop : loops) add(loop.keyframe, loop.place, &graph.loops);
    return graph;
  });
}

DetectorThread::Statistics System::detector_statistics() const {
  return detector_ ? detector_->statistics() : DetectorThread::Statistics{};
}

void System::Log(LogLevel level, const std::string& message) const {
  if (log_) log_(level, "system", message);
}

void System::Tell(Step step, double seconds) const {
  if (on_step_) on_step_(step, seconds);
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/pipeline/point_cloud_mapping.h"

#include <algorithm>
#include <utility>

#include "semslam/base/stopwatch.h"

namespace semslam {

void PointCloudMapping::Options::Validate() const {
  cloud.Validate();
  voxels.Validate();
  segmentation.Validate();
  live.Validate();
  fusion.Validate();
}

PointCloudMapping::PointCloudMapping(Threading threading,
                                     const Options& options,
                                     const PinholeCamera& camera,
                                     ClassTable classes,
                                     PlaceLookup look_up)
    : options_(options),
      threading_(threading),
      rays_(std::make_shared<const RayTable>(camera)),
      classes_(std::move(classes)),
      look_up_(std::move(look_up)),
      voxel_map_(options.voxels),
      live_segments_(options.live, options.segmentation, &voxel_map_),
      stage_(
          {.threading = threading, .queue_capacity = options.queue_capacity, .is_background = true},
          [this](Job job) { Process(std::move(job)); }) {
  options_.Validate();
}

bool PointCloudMapping::InsertKeyframe(KeyframeId keyframe, RgbdImagePtr image) {
  return stage_.Submit(
      {.kind = Job::Kind::kKeyframe, .keyframe = keyframe, .image = std::move(image)});
}

bool PointCloudMapping::InsertDetections(KeyframeId keyframe, std::vector<Detection> detections) {
  return stage_.Submit(
      {.kind = Job::Kind::kDetections, .keyframe = keyframe, .detections = std::move(detections)});
}

void PointCloudMapping::FollowCorrection() { stage_.TrySubmit({.kind = Job::Kind::kCorrection}); }

std::vector<std::shared_ptr<const KeyframeCloud>> PointCloudMapping::clouds() const {
  return sight_.Read([](const Sight& sight) {
    std::vector<std::shared_ptr<const KeyframeCloud>> clouds;
    clouds.reserve(sight.clouds.size());
    for (const auto& [id, cloud] : sight.clouds) clouds.push_back(cloud);
    return clouds;
  });
}

void PointCloudMapping::RequestPreview() {
  if (threading_ == Threading::kInline) return;
  sight_.Write([](Sight& sight) { sight.preview_is_wanted = true; });
  stage_.TrySubmit({.kind = Job::Kind::kPreview});  // If the queue is full, others come anyway.
}

std::shared_ptr<const PointCloudMapping::Result> PointCloudMapping::preview() const {
  return sight_.Read([](const Sight& sight) { return sight.preview; });
}

void PointCloudMapping::Process(Job job) {
  Do(std::move(job));
  // Segments are made to be looked at: what waits to be integrated goes first.
  if (stage_.queue_size() == 0) FollowWithSegments();
  const bool is_wanted = sight_.Read([](const Sight& sight) { return sight.preview_is_wanted; });
  // Keyframes may wait a little, as long as nobody has to wait for room in the queue.
  if (is_wanted && stage_.queue_size() <= options_.queue_capacity / 4) ShowPreview();
}

void PointCloudMapping::ShowPreview() {
  std::shared_ptr<const Result> shown = preview();
  if (num_changes_ != num_changes_shown_) {
    num_changes_shown_ = num_changes_;
    // In this background thread alone, so that tracking keeps its core.
    Segmenter::Options segmentation = options_.segmentation;
    segmentation.num_threads = 1;
    shown =
        std::make_shared<const Result>(Build(segmentation, shown ? &shown->semantics : nullptr));
  }
  sight_.Write([&](Sight& sight) {
    sight.preview = std::move(shown);
    sight.preview_is_wanted = false;
  });
}

void PointCloudMapping::Do(Job job) {
  if (job.kind != Job::Kind::kPreview) ++num_changes_;
  switch (job.kind) {
    case Job::Kind::kKeyframe:
      return Integrate(job.keyframe, *job.image);
    case Job::Kind::kDetections:
      detections_[job.keyframe] = std::move(job.detections);
      return;
    case Job::Kind::kCorrection:
      segments_lag_ = Lag::kMap;
      return FollowPoses(options_.voxels.max_shift);
    case Job::Kind::kPreview:
      return;  // It comes after everything.
  }
}

void PointCloudMapping::FollowWithSegments() {
  switch (std::exchange(segments_lag_, Lag::kNone)) {
    case Lag::kNone:
      return;
    case Lag::kKeyframe:
      return live_segments_.Follow();
    case Lag::kMap:
      return live_segments_.FollowCorrection();
  }
}

void PointCloudMapping::Integrate(KeyframeId keyframe, const RgbdImage& image) {
  const Stopwatch stopwatch;
  auto cloud = BuildKeyframeCloud(keyframe, image, rays_, options_.cloud);
  sight_.Write([&](Sight& sight) { sight.clouds[keyframe] = cloud; });
  clouds_[keyframe] = std::move(cloud);
  FollowPoses(options_.voxels.max_shift);
  integration_seconds_ += stopwatch.Seconds();
  ++num_integrated_;
  segments_lag_ = std::max(segments_lag_, Lag::kKeyframe);
  num_voxels_.Write([&](std::size_t& n) { n = voxel_map_.num_voxels(); });
}

void PointCloudMapping::FollowPoses(double max_shift) {
  std::vector<KeyframeId> ids;
  for (const auto& [id, cloud] : clouds_) ids.push_back(id);
  const Places places = look_up_(ids);
  for (const KeyframeId id : ids) {
    if (places.T_world_camera.contains(id)) continue;
    voxel_map_.Remove(id);
    if (places.apart.contains(id)) continue;
    clouds_.erase(id);
    sight_.Write([id](Sight& sight) { sight.clouds.erase(id); });
    detections_.erase(id);
  }
  voxel_map_.UpdatePoses(places.T_world_camera, max_shift);
  for (const auto& [id, T_world_camera] : places.T_world_camera) {
    if (!voxel_map_.Contains(id)) voxel_map_.Integrate(clouds_.at(id), T_world_camera);
  }
}

std::vector<LabelledKeyframe> PointCloudMapping::LabelledKeyframes() const {
  std::vector<KeyframeId> ids;
  for (const auto& [id, detections] : detections_) ids.push_back(id);
  const std::map<KeyframeId, Rigid3> poses = look_up_(ids).T_world_camera;
  std::vector<LabelledKeyframe> views;
  for (const auto& [id, detections] : detections_) {
    const auto cloud = clouds_.find(id);
    const auto pose = poses.find(id);
    if (cloud == clouds_.end() || pose == poses.end()) continue;
    views.push_back({cloud->second, pose->second, detections});
  }
  return views;
}

PointCloudMapping::Result PointCloudMapping::Finish() {
  stage_.Finish();
  FollowPoses(0.0);  // The final map is exact.
  return Build(options_.segmentation, nullptr);
}

PointCloudMapping::Result PointCloudMapping::Build(const Segmenter::Options& segmentation,
                                                   const SemanticMap* previous) const {
  Result result;
  result.cloud = voxel_map_.Extract();
  Stopwatch stopwatch;
  result.segmentation =
      Segmenter(segmentation)
          .Segment({.points = result.cloud.positions, .normals = result.cloud.normals});
  result.segmentation_milliseconds = stopwatch.Milliseconds();
  stopwatch.Restart();
  const VoxelIndex index(result.cloud.positions, result.cloud.voxel_size);
  result.semantics = BuildSemanticMap(result.cloud, index, result.segmentation, LabelledKeyframes(),
                                      classes_, options_.fusion, previous);
  result.fusion_milliseconds = stopwatch.Milliseconds();
  result.live = live_segments_.statistics();
  if (num_integrated_ > 0) {
    result.integration_milliseconds =
        1e3 * integration_seconds_ / static_cast<double>(num_integrated_);
  }
  return result;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/pipeline/point_cloud_mapping.h"

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
                                     PoseLookup pose_lookup)
    : options_(options),
      rays_(std::make_shared<const RayTable>(camera)),
      classes_(std::move(classes)),
      pose_lookup_(std::move(pose_lookup)),
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

void PointCloudMapping::Process(Job job) {
  switch (job.kind) {
    case Job::Kind::kKeyframe:
      return Integrate(job.keyframe, *job.image);
    case Job::Kind::kDetections:
      detections_[job.keyframe] = std::move(job.detections);
      return;
    case Job::Kind::kCorrection:
      FollowPoses(options_.voxels.max_shift);
      return live_segments_.FollowCorrection();
  }
}

void PointCloudMapping::Integrate(KeyframeId keyframe, const RgbdImage& image) {
  const std::map<KeyframeId, Rigid3> poses = pose_lookup_({keyframe});
  if (poses.empty()) return;  // The map was cleared since.
  const Stopwatch stopwatch;
  auto cloud = BuildKeyframeCloud(keyframe, image, rays_, options_.cloud);
  voxel_map_.Integrate(cloud, poses.begin()->second);
  clouds_[keyframe] = std::move(cloud);
  FollowPoses(options_.voxels.max_shift);
  integration_seconds_ += stopwatch.Seconds();
  ++num_integrated_;
  live_segments_.Follow();
  num_voxels_.Write([&](std::size_t& n) { n = voxel_map_.num_voxels(); });
}

void PointCloudMapping::FollowPoses(double max_shift) {
  std::vector<KeyframeId> ids;
  for (const auto& [id, cloud] : clouds_) ids.push_back(id);
  const std::map<KeyframeId, Rigid3> poses = pose_lookup_(ids);
  for (const KeyframeId id : ids) {
    if (poses.contains(id)) continue;
    voxel_map_.Remove(id);
    clouds_.erase(id);
    detections_.erase(id);
  }
  voxel_map_.UpdatePoses(poses, max_shift);
}

std::vector<LabelledKeyframe> PointCloudMapping::LabelledKeyframes() const {
  std::vector<KeyframeId> ids;
  for (const auto& [id, detections] : detections_) ids.push_back(id);
  const std::map<KeyframeId, Rigid3> poses = pose_lookup_(ids);
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
  Result result;
  result.cloud = voxel_map_.Extract();
  Stopwatch stopwatch;
  result.segmentation =
      Segmenter(options_.segmentation)
          .Segment({.points = result.cloud.positions, .normals = result.cloud.normals});
  result.segmentation_milliseconds = stopwatch.Milliseconds();
  stopwatch.Restart();
  const VoxelIndex index(result.cloud.positions, result.cloud.voxel_size);
  result.semantics = BuildSemanticMap(result.cloud, index, result.segmentation, LabelledKeyframes(),
                                      classes_, options_.fusion);
  result.fusion_milliseconds = stopwatch.Milliseconds();
  result.live = live_segments_.statistics();
  if (num_integrated_ > 0) {
    result.integration_milliseconds =
        1e3 * integration_seconds_ / static_cast<double>(num_integrated_);
  }
  return result;
}

}  // namespace semslam

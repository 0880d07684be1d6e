// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/live_points.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "semslam/base/stopwatch.h"

namespace semslam {

void LivePoints::Follow(const std::vector<LiveCloud>& clouds) {
  std::set<KeyframeId> present;
  is_complete_ = true;
  bool may_add = true;
  for (const LiveCloud& live : clouds) {
    const KeyframeId id = live.cloud->id();
    present.insert(id);
    const auto chunk = chunks_.find(id);
    if (chunk != chunks_.end()) {
      chunk->second.T_world_keyframe = live.T_world_keyframe;
      renderer_->SetPose(chunk->second.id, live.T_world_keyframe);
    } else if (may_add) {
      Add(live);
      may_add = false;
    } else {
      is_complete_ = false;
    }
  }
  for (auto chunk = chunks_.begin(); chunk != chunks_.end();) {
    const auto next = std::next(chunk);
    if (!present.contains(chunk->first)) Remove(chunk);
    chunk = next;
  }
}

void LivePoints::Add(const LiveCloud& live) {
  const KeyframeId id = live.cloud->id();
  Chunk chunk;
  chunk.T_world_keyframe = live.T_world_keyframe;
  live.cloud->ForEach([&](const KeyframePoint& point) {
    const auto voxel =
        VoxelKey::Coordinates(live.T_world_keyframe * point.p_camera.cast<double>(), voxel_size_);
    if (!voxel) return;
    const std::uint64_t key = VoxelKey::Pack(*voxel);
    if (!owner_of_voxel_.try_emplace(key, id).second) return;
    chunk.voxels.push_back(key);
    chunk.columns.positions.push_back(point.p_camera);
    chunk.columns.normals.push_back(point.n_camera);
    chunk.columns.colors.push_back(point.color);
  });
  chunk.id = renderer_->AddChunk(chunk.columns.positions, chunk.columns.normals);
  renderer_->SetPose(chunk.id, chunk.T_world_keyframe);
  Color(chunks_.emplace(id, std::move(chunk)).first->second);
}

void LivePoints::Remove(std::map<KeyframeId, Chunk>::iterator chunk) {
  for (const std::uint64_t voxel : chunk->second.voxels) owner_of_voxel_.erase(voxel);
  renderer_->RemoveChunk(chunk->second.id);
  chunks_.erase(chunk);
}

void LivePoints::SetMap(std::shared_ptr<const LiveMap> map) {
  if (map == map_ || map == nullptr) return;
  map_ = std::move(map);
  index_ = VoxelIndex(map_->map.cloud.positions, map_->map.point_size);
  level_ = FindLevelFrame(map_->map);
  heights_ = FindHeightRange(map_->map.cloud.positions, level_.up);
  if (mode_ != ColorMode::kPhoto) ++coloring_;
}

void LivePoints::SetMode(ColorMode mode) {
  if (mode == mode_) return;
  mode_ = mode;
  ++coloring_;
}

void LivePoints::Color() {
  constexpr double kMaxSeconds = 0.02;
  const Stopwatch stopwatch;
  for (auto& [id, chunk] : chunks_) {
    if (chunk.colored == coloring_) continue;
    if (stopwatch.Seconds() > kMaxSeconds) {
      is_complete_ = false;
      return;
    }
    Color(chunk);
  }
}

void LivePoints::Color(Chunk& chunk) {
  chunk.colored = coloring_;
  CloudView cloud = chunk.columns.View();
  std::vector<Eigen::Vector3f> world;
  std::vector<std::uint32_t> labels;
  std::vector<std::uint32_t> segments;
  if (mode_ != ColorMode::kPhoto) {
    world.reserve(cloud.positions.size());
    for (const Eigen::Vector3f& p : cloud.positions)
      world.push_back((chunk.T_world_keyframe * p.cast<double>()).cast<float>());
    cloud.positions = world;
  }
  const bool takes_labels = mode_ == ColorMode::kClasses || mode_ == ColorMode::kSegments;
  if (map_ != nullptr && takes_labels) {
    const CloudView& known = map_->map.cloud;
    for (const Eigen::Vector3f& p : world) {
      const std::optional<std::uint32_t> found = index_.Find(p.cast<double>());
      labels.push_back(found && !known.labels.empty() ? known.labels[*found] : 0);
      segments.push_back(found && !known.segments.empty() ? known.segments[*found] : 0);
    }
    cloud.labels = labels;
    cloud.segments = segments;
  }
  LabelledMapView view;
  view.cloud = cloud;
  if (map_ != nullptr) view.classes = map_->map.classes;
  renderer_->SetColors(chunk.id, PointColors(view, mode_, level_.up, heights_));
}

std::vector<Eigen::Vector3f> LivePoints::Sample() const {
  constexpr std::size_t kPerChunk = 1000;
  std::vector<Eigen::Vector3f> points;
  for (const auto& [id, chunk] : chunks_) {
    const auto& positions = chunk.columns.positions;
    const std::size_t step = std::max<std::size_t>(1, positions.size() / kPerChunk);
    for (std::size_t i = 0; i < positions.size(); i += step)
      points.push_back((chunk.T_world_keyframe * positions[i].cast<double>()).cast<float>());
  }
  return points;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <unordered_map>
#include <vector>

#include "semslam/dense/voxel_index.h"
#include "semslam/viewer/live_source.h"
#include "semslam/viewer/map_scene.h"
#include "semslam/viewer/renderer.h"

namespace semslam {

// The dense map of a run on the graphics card: a chunk for each keyframe, which moves with it. Of
// points that several keyframes saw, the first one's is kept, so that their number follows the
// surface. A little is done at a time, so that the picture never stands still for long.
class LivePoints {
 public:
  LivePoints(Renderer* renderer, double voxel_size)
      : renderer_(renderer), voxel_size_(voxel_size) {}

  // Adds one new keyframe at most, moves the others, drops those that are gone.
  void Follow(const std::vector<LiveCloud>& clouds);
  // Segments and classes come from this map from now on.
  void SetMap(std::shared_ptr<const LiveMap> map);
  void SetMode(ColorMode mode);
  // Colours a few of the chunks that need it.
  void Color();
  // All is shown as it is to be.
  bool is_complete() const { return is_complete_; }

  const LevelFrame& level() const { return level_; }
  const HeightRange& heights() const { return heights_; }
  // Some of the points, in the world.
  std::vector<Eigen::Vector3f> Sample() const;

 private:
  struct Chunk {
    Renderer::ChunkId id = 0;
    Rigid3 T_world_keyframe;
    CloudColumns columns;               // In the keyframe's frame.
    std::vector<std::uint64_t> voxels;  // That only this chunk fills.
    std::uint64_t colored = 0;          // Which colouring it has.
  };

  void Add(const LiveCloud& live);
  void Remove(std::map<KeyframeId, Chunk>::iterator chunk);
  void Color(Chunk& chunk);

  Renderer* renderer_;
  double voxel_size_;
  std::map<KeyframeId, Chunk> chunks_;
  std::unordered_map<std::uint64_t, KeyframeId> owner_of_voxel_;
  std::shared_ptr<const LiveMap> map_;
  VoxelIndex index_;  // Of the map's points.
  LevelFrame level_;
  HeightRange heights_;
  ColorMode mode_ = ColorMode::kPhoto;
  std::uint64_t coloring_ = 1;
  bool is_complete_ = false;
};

}  // namespace semslam

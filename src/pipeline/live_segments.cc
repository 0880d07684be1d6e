// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/pipeline/live_segments.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "semslam/base/error.h"
#include "semslam/base/stopwatch.h"
#include "semslam/dense/voxel_index.h"

namespace semslam {
namespace {

LiveSegmenter::Options SegmenterOptions(const LiveSegments::Options& options,
                                        const Segmenter::Options& segmentation) {
  LiveSegmenter::Options result;
  result.segmentation = segmentation;
  result.segmentation.num_threads = options.num_threads;
  result.max_voxels = options.max_voxels;
  return result;
}

double Mean(const std::vector<double>& values, std::size_t first, std::size_t last) {
  if (first == last) return 0;
  const auto at = [&](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
  return std::accumulate(at(first), at(last), 0.0) / static_cast<double>(last - first);
}

}  // namespace

void LiveSegments::Options::Validate() const {
  if (max_voxels == 0) throw InputError("live segments: expected max_voxels >= 1");
  if (num_threads < 0) throw InputError("live segments: expected num_threads >= 0");
}

LiveSegments::LiveSegments(const Options& options,
                           const Segmenter::Options& segmentation,
                           VoxelMap* voxel_map)
    : options_(options),
      voxel_map_(voxel_map),
      segmenter_(SegmenterOptions(options, segmentation)) {
  if (options_.enabled) voxel_map_->RecordChanges();
}

void LiveSegments::TakeChanges() {
  VoxelMap::Changes changes = voxel_map_->TakeChanges();
  segmenter_.Update({.appeared = std::move(changes.appeared),
                     .vanished = std::move(changes.vanished),
                     .moved = std::move(changes.moved)});
}

void LiveSegments::SegmentRegion(const LiveSegmenter::Region& region) {
  if (region.empty()) return;
  const MapCloud cloud = voxel_map_->Extract(region.voxels);
  segmenter_.Segment(region, {.points = cloud.positions, .normals = cloud.normals});
}

void LiveSegments::Follow() {
  if (!options_.enabled) return;
  const Stopwatch stopwatch;
  TakeChanges();
  SegmentRegion(segmenter_.NextRegion());
  milliseconds_.push_back(stopwatch.Milliseconds());
  PublishIfAsked();
}

void LiveSegments::FollowCorrection() {
  if (!options_.enabled) return;
  TakeChanges();
  SegmentRegion(segmenter_.WholeMap());
  PublishIfAsked();
}

void LiveSegments::RequestMap() {
  published_.Write([](Published& published) { published.is_requested = true; });
}

std::shared_ptr<const SegmentedCloud> LiveSegments::map() const {
  return published_.Read([](const Published& published) { return published.map; });
}

void LiveSegments::PublishIfAsked() {
  if (!published_.Read([](const Published& published) { return published.is_requested; })) return;
  auto map = std::make_shared<const SegmentedCloud>(MakeMap());
  published_.Write(
      [&](Published& published) { published = {.is_requested = false, .map = std::move(map)}; });
}

SegmentedCloud LiveSegments::MakeMap() const {
  SegmentedCloud map;
  map.cloud = voxel_map_->Extract();
  map.segment_of_point.reserve(map.cloud.size());
  for (const Eigen::Vector3f& position : map.cloud.positions) {
    const auto voxel = VoxelKey::Coordinates(position.cast<double>(), map.cloud.voxel_size);
    map.segment_of_point.push_back(voxel ? segmenter_.IdOf(VoxelKey::Pack(*voxel)) : 0);
  }
  return map;
}

LiveSegments::Statistics LiveSegments::statistics() const {
  const std::size_t count = milliseconds_.size();
  Statistics statistics;
  statistics.num_keyframes = count;
  statistics.num_segments = segmenter_.num_segments();
  statistics.mean_milliseconds = Mean(milliseconds_, 0, count);
  statistics.first_half_milliseconds = Mean(milliseconds_, 0, count / 2);
  statistics.second_half_milliseconds = Mean(milliseconds_, count / 2, count);
  if (count > 0) {
    statistics.max_milliseconds = *std::max_element(milliseconds_.begin(), milliseconds_.end());
  }
  return statistics;
}

}  // namespace semslam

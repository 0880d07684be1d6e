// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/summary.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "semslam/base/parallel.h"

#include "segmentation/voxel_groups.h"

namespace semslam {
namespace {

constexpr std::size_t kGrain = 16384;

// The voxels' centroids, in the cloud's coordinates.
std::vector<Eigen::Vector3d> PointsOf(const VoxelGrid& grid,
                                      std::span<const std::uint32_t> voxels) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(voxels.size());
  for (const std::uint32_t voxel : voxels) {
    points.push_back(grid.origin + grid.centroids[voxel].cast<double>());
  }
  return points;
}

// By the id of the segment; 0: of none.
std::vector<std::size_t> CountPoints(std::span<const SegmentId> segment_of_point,
                                     std::size_t num_ids,
                                     int num_threads) {
  constexpr std::size_t kNumChunks = 8;
  const std::size_t size = segment_of_point.size();
  std::vector<std::vector<std::size_t>> of_chunks(kNumChunks);
  ParallelFor(kNumChunks, 1, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t chunk = begin; chunk < end; ++chunk) {
      of_chunks[chunk].resize(num_ids);
      for (std::size_t i = size * chunk / kNumChunks; i < size * (chunk + 1) / kNumChunks; ++i) {
        ++of_chunks[chunk][segment_of_point[i]];
      }
    }
  });
  std::vector<std::size_t> counts(num_ids, 0);
  for (const std::vector<std::size_t>& chunk : of_chunks) {
    for (std::size_t id = 0; id < counts.size(); ++id) counts[id] += chunk[id];
  }
  return counts;
}

void LinkNeighbours(const PatchGraph& graph,
                    const Components& components,
                    std::vector<Segment>& segments) {
  for (const PatchEdge& edge : graph.edges) {
    const std::uint32_t a = components.component_of_patch[edge.a];
    const std::uint32_t b = components.component_of_patch[edge.b];
    if (a == b || a == kNoComponent || b == kNoComponent) continue;
    segments[a].neighbours.push_back(b + 1);
    segments[b].neighbours.push_back(a + 1);
  }
  for (Segment& segment : segments) {
    std::vector<SegmentId>& ids = segment.neighbours;
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  }
}

}  // namespace

std::vector<Plane> ToCloudFrame(const std::vector<Plane>& planes,
                                const PatchGraph& graph,
                                const std::vector<std::uint32_t>& plane_labels,
                                const Eigen::Vector3d& origin) {
  std::vector<double> votes(planes.size(), 0.0);
  for (std::size_t i = 0; i < graph.patches.size(); ++i) {
    if (plane_labels[i] == 0) continue;
    const Patch& patch = graph.patches[i];
    votes[plane_labels[i] - 1] += patch.area * patch.normal.dot(planes[plane_labels[i] - 1].normal);
  }
  std::vector<Plane> result;
  result.reserve(planes.size());
  for (std::size_t m = 0; m < planes.size(); ++m) {
    const Plane plane = votes[m] < 0 ? planes[m].Flipped() : planes[m];
    result.push_back({plane.normal, plane.offset - plane.normal.dot(origin)});
  }
  return result;
}

LargeVector<SegmentId> SegmentOfVoxels(const Supervoxels& supervoxels,
                                       const Components& components,
                                       int num_threads) {
  LargeVector<SegmentId> segment_of_voxel(supervoxels.patch_of_voxel.size());
  ParallelFor(segment_of_voxel.size(), kGrain, num_threads,
              [&](std::size_t first, std::size_t last) {
                for (std::size_t voxel = first; voxel < last; ++voxel) {
                  const std::uint32_t patch = supervoxels.patch_of_voxel[voxel];
                  const std::uint32_t component =
                      patch == kNoPatch ? kNoComponent : components.component_of_patch[patch];
                  segment_of_voxel[voxel] = component == kNoComponent ? 0 : component + 1;
                }
              });
  return segment_of_voxel;
}

std::vector<Segment> Summarise(const VoxelGrid& grid,
                               const PatchGraph& graph,
                               const Components& components,
                               const std::vector<Plane>& planes,
                               const LargeVector<SegmentId>& segment_of_voxel,
                               const std::vector<SegmentId>& segment_of_point,
                               int num_threads) {
  const std::size_t num_ids = components.components.size() + 1;
  const VoxelGroups voxels = GroupVoxels(segment_of_voxel, num_ids, num_threads);
  const std::vector<std::size_t> num_points = CountPoints(segment_of_point, num_ids, num_threads);
  std::vector<Segment> segments(components.components.size());
  ParallelFor(segments.size(), 1, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Component& component = components.components[i];
      Segment& segment = segments[i];
      segment.id = static_cast<SegmentId>(i + 1);
      segment.num_points = num_points[segment.id];
      const std::vector<Eigen::Vector3d> points = PointsOf(grid, voxels.Of(segment.id));
      for (const Eigen::Vector3d& point : points) segment.centroid += point;
      segment.centroid /= static_cast<double>(std::max<std::size_t>(points.size(), 1));
      segment.box = FitOrientedBox(points);
      if (component.plane_label != 0) segment.plane = planes[component.plane_label - 1];
      segment.area = component.area;
      segment.is_structural = component.is_structural;
    }
  });
  LinkNeighbours(graph, components, segments);
  return segments;
}

}  // namespace semslam

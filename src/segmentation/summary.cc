// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/summary.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "semslam/base/parallel.h"

namespace semslam {
namespace {

// The voxels of all segments, segment by segment: those of id i are voxels[begin[i] .. begin[i +
// 1]).
struct VoxelsBySegment {
  std::vector<std::uint32_t> voxels;
  std::vector<std::size_t> begin;
};

VoxelsBySegment SortBySegment(const std::vector<SegmentId>& segment_of_voxel,
                              std::size_t num_segments) {
  VoxelsBySegment result{{}, std::vector<std::size_t>(num_segments + 2, 0)};
  for (const SegmentId id : segment_of_voxel) ++result.begin[id + 1];
  std::partial_sum(result.begin.begin(), result.begin.end(), result.begin.begin());
  std::vector<std::size_t> next = result.begin;
  result.voxels.resize(segment_of_voxel.size());
  for (std::size_t voxel = 0; voxel < segment_of_voxel.size(); ++voxel) {
    result.voxels[next[segment_of_voxel[voxel]]++] = static_cast<std::uint32_t>(voxel);
  }
  return result;
}

// Their centroids, in the cloud's coordinates.
std::vector<Eigen::Vector3d> PointsOf(const VoxelGrid& grid,
                                      const VoxelsBySegment& voxels,
                                      SegmentId id) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(voxels.begin[id + 1] - voxels.begin[id]);
  for (std::size_t i = voxels.begin[id]; i < voxels.begin[id + 1]; ++i) {
    points.push_back(grid.origin + grid.centroids[voxels.voxels[i]].cast<double>());
  }
  return points;
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

std::vector<SegmentId> SegmentOfVoxels(const Supervoxels& supervoxels,
                                       const Components& components) {
  std::vector<SegmentId> segment_of_voxel;
  segment_of_voxel.reserve(supervoxels.patch_of_voxel.size());
  for (const std::uint32_t patch : supervoxels.patch_of_voxel) {
    const std::uint32_t component =
        patch == kNoPatch ? kNoComponent : components.component_of_patch[patch];
    segment_of_voxel.push_back(component == kNoComponent ? 0 : component + 1);
  }
  return segment_of_voxel;
}

std::vector<Segment> Summarise(const VoxelGrid& grid,
                               const PatchGraph& graph,
                               const Components& components,
                               const std::vector<Plane>& planes,
                               const std::vector<SegmentId>& segment_of_voxel,
                               const std::vector<SegmentId>& segment_of_point,
                               int num_threads) {
  const VoxelsBySegment voxels = SortBySegment(segment_of_voxel, components.components.size());
  std::vector<Segment> segments(components.components.size());
  ParallelFor(segments.size(), 1, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Component& component = components.components[i];
      Segment& segment = segments[i];
      segment.id = static_cast<SegmentId>(i + 1);
      const std::vector<Eigen::Vector3d> points = PointsOf(grid, voxels, segment.id);
      for (const Eigen::Vector3d& point : points) segment.centroid += point;
      segment.centroid /= static_cast<double>(std::max<std::size_t>(points.size(), 1));
      segment.box = FitOrientedBox(points);
      if (component.plane_label != 0) segment.plane = planes[component.plane_label - 1];
      segment.area = component.area;
      segment.is_structural = component.is_structural;
    }
  });
  for (const SegmentId id : segment_of_point) {
    if (id != 0) ++segments[id - 1].num_points;
  }
  LinkNeighbours(graph, components, segments);
  return segments;
}

}  // namespace semslam

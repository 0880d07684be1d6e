// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/segmentation/segmenter.h"

#include <utility>

#include "semslam/base/large_vector.h"
#include "semslam/base/parallel.h"
#include "semslam/base/stopwatch.h"

#include "segmentation/components.h"
#include "segmentation/patches.h"
#include "segmentation/plane_assignment.h"
#include "segmentation/plane_hypotheses.h"
#include "segmentation/plane_scores.h"
#include "segmentation/plane_selection.h"
#include "segmentation/relief.h"
#include "segmentation/summary.h"
#include "segmentation/supervoxels.h"
#include "segmentation/surface_growth.h"
#include "segmentation/voxel_grid.h"
#include "segmentation/voxel_normals.h"

namespace semslam {
namespace {

double Lap(Stopwatch& watch) {
  const double milliseconds = watch.Milliseconds();
  watch.Restart();
  return milliseconds;
}

std::vector<Plane> KeepSelected(const std::vector<Plane>& planes,
                                const std::vector<bool>& is_selected) {
  std::vector<Plane> selected;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (is_selected[i]) selected.push_back(planes[i]);
  }
  return selected;
}

std::vector<SegmentId> SegmentOfPoints(const VoxelGrid& grid,
                                       const LargeVector<SegmentId>& segment_of_voxel,
                                       int num_threads) {
  constexpr std::size_t kGrain = 16384;
  std::vector<SegmentId> segment_of_point(grid.voxel_of_point.size());
  ParallelFor(segment_of_point.size(), kGrain, num_threads,
              [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i) {
                  const std::uint32_t voxel = grid.voxel_of_point[i];
                  segment_of_point[i] = voxel == kNoVoxel ? 0 : segment_of_voxel[voxel];
                }
              });
  return segment_of_point;
}

}  // namespace

Segmenter::Segmenter(const Options& options) : options_(options) { options_.Validate(); }

Segmentation Segmenter::Segment(const PointCloudView& cloud, const StepObserver& on_step) const {
  const int num_threads = options_.num_threads;
  const auto begin = [&](std::string_view step) {
    if (on_step) on_step(step);
  };
  Segmentation result;
  Stopwatch watch;

  begin("voxels");
  const VoxelGrid grid = BuildConnectedVoxelGrid(
      cloud, options_.supervoxels.voxel_size, options_.supervoxels.max_voxel_growth, num_threads);
  result.times.voxels = Lap(watch);
  begin("normals");
  const std::vector<Eigen::Vector3f> normals = ComputeVoxelNormals(grid, num_threads);
  result.times.normals = Lap(watch);
  begin("supervoxels");
  Supervoxels supervoxels = GrowSupervoxels(grid, normals, options_.supervoxels, num_threads);
  result.times.supervoxels = Lap(watch);
  PatchGraph graph = BuildPatchGraph(grid, normals, supervoxels, num_threads);
  result.times.patches = Lap(watch);

  begin("planes");
  std::vector<Plane> planes = ProposePlanes(graph.patches, options_.planes, num_threads);
  result.num_hypotheses = planes.size();
  result.times.planes = Lap(watch);
  begin("plane selection");
  const SelectionEnergy energy =
      MakeSelectionEnergy(graph.patches, planes, options_.planes, num_threads);
  planes = KeepSelected(planes, SelectPlanes(energy, options_.selection));
  result.times.selection = Lap(watch);
  begin("plane assignment");
  std::vector<std::uint32_t> plane_labels =
      AssignPlanes(graph, planes, options_.planes, options_.assignment);
  plane_labels = GrowSurfaces(graph, planes, std::move(plane_labels), options_.components);
  result.times.assignment = Lap(watch);
  begin("relief");
  CutPatches cut =
      CutAtRelief(grid, supervoxels, graph, planes, plane_labels,
                  options_.components.min_structural_area, options_.relief, num_threads);
  supervoxels = std::move(cut.supervoxels);
  plane_labels = std::move(cut.plane_labels);
  graph = UpdatePatchGraph(grid, normals, supervoxels, graph, cut.old_number, num_threads);
  result.times.relief = Lap(watch);

  begin("segments");
  const Components components = FindComponents(graph, plane_labels, options_.components,
                                               {grid.centroids, supervoxels.patch_of_voxel});
  const LargeVector<SegmentId> segment_of_voxel =
      SegmentOfVoxels(supervoxels, components, num_threads);
  result.segment_of_point = SegmentOfPoints(grid, segment_of_voxel, num_threads);
  result.times.components = Lap(watch);
  result.planes = ToCloudFrame(planes, graph, plane_labels, grid.origin);
  result.segments = Summarise(grid, graph, components, result.planes, segment_of_voxel,
                              result.segment_of_point, num_threads);
  result.voxel_size = grid.voxel_size;
  result.num_voxels = grid.size();
  result.num_supervoxels = graph.patches.size();
  result.times.summary = Lap(watch);
  return result;
}

double SegmentationTimes::Total() const {
  return voxels + normals + supervoxels + patches + planes + selection + assignment + relief +
         components + summary;
}

}  // namespace semslam

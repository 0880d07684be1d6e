// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_methods.h"

#include <limits>
#include <map>
#include <set>

#include <pcl/features/normal_3d.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/lccp_segmentation.h>
#include <pcl/segmentation/region_growing.h>
#include <pcl/segmentation/supervoxel_clustering.h>

#include "semslam/base/stopwatch.h"

namespace {

using semslam::PointCloudView;
using semslam::SegmentId;

// The finite points of a cloud, and where they stood.
template <typename Point>
struct FinitePoints {
  typename pcl::PointCloud<Point>::Ptr cloud{new pcl::PointCloud<Point>};
  std::vector<std::size_t> input_index;
};

template <typename Point>
FinitePoints<Point> FindFinite(const PointCloudView& view) {
  FinitePoints<Point> finite;
  for (std::size_t i = 0; i < view.points.size(); ++i) {
    if (!view.points[i].allFinite()) continue;
    Point point;
    point.getVector3fMap() = view.points[i];
    finite.cloud->push_back(point);
    finite.input_index.push_back(i);
  }
  return finite;
}

pcl::PointCloud<pcl::Normal>::Ptr NormalsOf(const PointCloudView& view,
                                            const std::vector<std::size_t>& indices) {
  pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  for (const std::size_t index : indices) {
    const Eigen::Vector3f& normal = view.normals[index];
    normals->push_back(pcl::Normal(normal.x(), normal.y(), normal.z()));
  }
  return normals;
}

std::size_t CountSegments(const std::vector<SegmentId>& segments) {
  std::set<SegmentId> distinct(segments.begin(), segments.end());
  distinct.erase(0);
  return distinct.size();
}

using LccpPoint = pcl::PointXYZRGBA;

struct PclSupervoxels {
  std::map<std::uint32_t, pcl::Supervoxel<LccpPoint>::Ptr> supervoxels;  // Empty: no points.
  std::multimap<std::uint32_t, std::uint32_t> adjacency;
  pcl::PointCloud<pcl::PointXYZL>::Ptr labelled;  // The finite points; 0: unassigned.
};

PclSupervoxels FindSupervoxels(const PointCloudView& view,
                               const FinitePoints<LccpPoint>& input,
                               const PclLccpOptions& options) {
  PclSupervoxels result;
  if (input.cloud->empty()) return result;
  pcl::SupervoxelClustering<LccpPoint> clustering(options.voxel_size, options.seed_spacing);
  clustering.setUseSingleCameraTransform(false);
  clustering.setInputCloud(input.cloud);
  if (!view.normals.empty()) clustering.setNormalCloud(NormalsOf(view, input.input_index));
  clustering.setColorImportance(0.0F);
  clustering.setSpatialImportance(options.spatial_weight);
  clustering.setNormalImportance(options.normal_weight);
  clustering.extract(result.supervoxels);
  if (result.supervoxels.empty()) return result;
  clustering.getSupervoxelAdjacency(result.adjacency);
  result.labelled = clustering.getLabeledCloud();
  return result;
}

}  // namespace

PclSegmentation SegmentWithLccp(const PointCloudView& view, const PclLccpOptions& options) {
  PclSegmentation result;
  result.segment_of_point.assign(view.points.size(), 0);
  const semslam::Stopwatch watch;
  const FinitePoints<LccpPoint> input = FindFinite<LccpPoint>(view);
  const PclSupervoxels found = FindSupervoxels(view, input, options);
  if (found.supervoxels.empty()) return result;

  pcl::LCCPSegmentation<LccpPoint> lccp;
  lccp.setConcavityToleranceThreshold(options.concavity_degrees);
  lccp.setSanityCheck(options.sanity_check);
  lccp.setSmoothnessCheck(true, options.voxel_size, options.seed_spacing, options.smoothness);
  lccp.setKFactor(options.extended_convexity);
  lccp.setMinSegmentSize(options.min_supervoxels);
  lccp.setInputSupervoxels(found.supervoxels, found.adjacency);
  lccp.segment();
  pcl::PointCloud<pcl::PointXYZL> relabelled = *found.labelled;
  lccp.relabelCloud(relabelled);
  for (std::size_t i = 0; i < relabelled.size(); ++i) {
    const bool is_assigned = (*found.labelled)[i].label != 0;
    result.segment_of_point[input.input_index[i]] = is_assigned ? relabelled[i].label : 0;
  }
  result.milliseconds = watch.Milliseconds();
  result.num_segments = CountSegments(result.segment_of_point);
  return result;
}

PclSegmentation SupervoxelsOfPcl(const PointCloudView& view, const PclLccpOptions& options) {
  PclSegmentation result;
  result.segment_of_point.assign(view.points.size(), 0);
  const semslam::Stopwatch watch;
  const FinitePoints<LccpPoint> input = FindFinite<LccpPoint>(view);
  const PclSupervoxels found = FindSupervoxels(view, input, options);
  result.num_segments = found.supervoxels.size();
  if (found.supervoxels.empty()) return result;
  for (std::size_t i = 0; i < found.labelled->size(); ++i) {
    result.segment_of_point[input.input_index[i]] = (*found.labelled)[i].label;
  }
  result.milliseconds = watch.Milliseconds();
  return result;
}

PclSegmentation SegmentWithRegionGrowing(const PointCloudView& view,
                                         const PclRegionGrowingOptions& options) {
  PclSegmentation result;
  result.segment_of_point.assign(view.points.size(), 0);
  const semslam::Stopwatch watch;
  const FinitePoints<pcl::PointXYZ> input = FindFinite<pcl::PointXYZ>(view);
  if (input.cloud->empty()) return result;

  const pcl::search::Search<pcl::PointXYZ>::Ptr tree(new pcl::search::KdTree<pcl::PointXYZ>);
  const pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setSearchMethod(tree);
  estimation.setInputCloud(input.cloud);
  estimation.setKSearch(options.num_neighbours);
  estimation.compute(*normals);

  constexpr float kRadiansPerDegree = 0.01745329252F;
  pcl::RegionGrowing<pcl::PointXYZ, pcl::Normal> growing;
  growing.setMinClusterSize(options.min_points);
  growing.setMaxClusterSize(std::numeric_limits<int>::max());
  growing.setSearchMethod(tree);
  growing.setNumberOfNeighbours(static_cast<unsigned>(options.num_neighbours));
  growing.setInputCloud(input.cloud);
  growing.setInputNormals(normals);
  growing.setSmoothnessThreshold(options.smoothness_degrees * kRadiansPerDegree);
  growing.setCurvatureThreshold(options.max_curvature);
  std::vector<pcl::PointIndices> regions;
  growing.extract(regions);
  for (std::size_t region = 0; region < regions.size(); ++region) {
    for (const auto index : regions[region].indices) {
      result.segment_of_point[input.input_index[static_cast<std::size_t>(index)]] =
          static_cast<SegmentId>(region + 1);
    }
  }
  result.milliseconds = watch.Milliseconds();
  result.num_segments = regions.size();
  return result;
}

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "semslam/segmentation/segmenter.h"

// PCL's segmentation methods, as a user of PCL would call them, to compare with. They run in the
// caller's thread. PCL promises neither equal results for equal input nor survival of odd input.

struct PclSegmentation {
  std::vector<semslam::SegmentId> segment_of_point;  // By index of the input point; 0: unassigned.
  std::size_t num_segments = 0;
  double milliseconds = 0;  // All of it, from points to segments.
};

// Supervoxels (Papon et al. 2013), then locally convex connected patches (Stein et al. 2014).
struct PclLccpOptions {
  float voxel_size = 0.008F;   // Metres. This and the next three as in SupervoxelOptions.
  float seed_spacing = 0.08F;  // Metres.
  float spatial_weight = 0.4F;
  float normal_weight = 1.0F;       // Colour has none.
  float concavity_degrees = 10.0F;  // As published, like the next one.
  float smoothness = 0.1F;
  bool sanity_check = true;         // Of patches that touch in a point only.
  unsigned extended_convexity = 0;  // Common neighbours that must agree.
  unsigned min_supervoxels = 0;     // Smaller segments go to a neighbour; 0: none.
};

// `cloud.normals`: unit normals of the surface towards the viewer, or empty: then PCL estimates
// them, turned towards the origin.
PclSegmentation SegmentWithLccp(const semslam::PointCloudView& cloud,
                                const PclLccpOptions& options = {});

// The supervoxels of the same, as they are; `options` has more than they need.
PclSegmentation SupervoxelsOfPcl(const semslam::PointCloudView& cloud,
                                 const PclLccpOptions& options = {});

// Region growing by smoothness (Rabbani et al. 2006); normals are estimated. As in PCL's tutorial
// but for the angle: the tutorial's 3 degrees leave crumbs of the depth images in
// evaluate_segmentation's table, 10 and more join everything.
struct PclRegionGrowingOptions {
  int num_neighbours = 30;  // Of normals, and of points when a region grows.
  float smoothness_degrees = 6.0F;
  float max_curvature = 1.0F;
  int min_points = 50;  // Of a region.
};

PclSegmentation SegmentWithRegionGrowing(const semslam::PointCloudView& cloud,
                                         const PclRegionGrowingOptions& options = {});

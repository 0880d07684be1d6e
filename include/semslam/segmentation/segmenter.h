// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "semslam/geometry/oriented_box.h"
#include "semslam/geometry/plane.h"
#include "semslam/segmentation/options.h"

namespace semslam {

// Points in metres. Points that are not finite, or farther from zero than a million voxels, stay
// unassigned.
struct PointCloudView {
  std::span<const Eigen::Vector3f> points;
  // Empty, or one a point. They tell the side of the surface that was seen: any vector towards the
  // viewer serves, its length and exact direction have no effect. Zero or not finite: unknown.
  // Without any, neighbouring surfaces are turned alike, and bends outwards can be taken for bends
  // inwards.
  std::span<const Eigen::Vector3f> normals;
};

// 0: unassigned. Segments are 1..N.
using SegmentId = std::uint32_t;

struct Segment {
  SegmentId id = 0;
  std::size_t num_points = 0;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  // Of its surface, evenly weighted.
  OrientedBox box;                                     // Around the centres of its voxels.
  std::optional<Plane> plane;                          // If all of it lies in one plane.
  double area = 0;                                     // Square metres.
  bool is_structural = false;                          // A large plane: floor, wall, table.
  std::vector<SegmentId> neighbours;                   // That touch it; ascending.
};

// Milliseconds.
struct SegmentationTimes {
  double voxels = 0;
  double normals = 0;
  double supervoxels = 0;
  double patches = 0;
  double planes = 0;
  double selection = 0;
  double assignment = 0;
  double relief = 0;
  double components = 0;
  double summary = 0;
  double Total() const;
};

struct Segmentation {
  std::vector<SegmentId> segment_of_point;  // By index of the input point.
  std::vector<Segment> segments;            // segments[i].id == i + 1.
  std::vector<Plane> planes;                // The selected planes; normals towards the viewer.
  double voxel_size = 0;                    // As used, metres.
  std::size_t num_voxels = 0;
  std::size_t num_supervoxels = 0;
  std::size_t num_hypotheses = 0;
  SegmentationTimes times;
};

// Divides a point cloud into surfaces and things by geometry alone: supervoxels, planes selected by
// a quadratic energy, a graph cut that gives planes to patches, and convex components of what is
// left (section 3.2 of the paper; Pham et al., IROS 2016). Equal points give equal bytes on any
// number of threads and in any order. Thread-safe: Segment changes nothing in the object.
class Segmenter {
 public:
  struct Options {
    SupervoxelOptions supervoxels;
    PlaneHypothesisOptions planes;
    PlaneSelectionOptions selection;
    PlaneAssignmentOptions assignment;
    ReliefOptions relief;
    ComponentOptions components;
    int num_threads = 0;  // 0: as many as there are cores.
    // Throws std::invalid_argument with the field's name and value.
    void Validate() const;
  };

  // Told before each step what it is; what it throws ends the segmentation and comes out of it.
  using StepObserver = std::function<void(std::string_view step)>;

  explicit Segmenter(const Options& options);

  Segmentation Segment(const PointCloudView& cloud, const StepObserver& on_step = {}) const;

 private:
  Options options_;
};

}  // namespace semslam

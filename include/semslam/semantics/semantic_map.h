// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "semslam/dense/map_cloud.h"
#include "semslam/dense/voxel_index.h"
#include "semslam/geometry/oriented_box.h"
#include "semslam/segmentation/segmenter.h"
#include "semslam/semantics/class_table.h"
#include "semslam/semantics/evidence.h"

namespace semslam {

using ObjectId = std::uint32_t;  // From 1; 0: no object.

// One thing of a known class in the world.
struct SemanticObject {
  ObjectId id = 0;
  int class_id = kNoClass;
  double confidence = 0;        // Probability of its class, in [0, 1].
  double entropy = 1;           // Of its distribution over classes: 0 sure, 1 nothing is known.
  std::uint32_t num_views = 0;  // Keyframes in which the detector saw it.
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  // World, metres; mean of its points.
  // World. Of what stands on a level plane: upright, and down to the plane.
  OrientedBox box;
  std::size_t num_points = 0;
  std::vector<SegmentId> segments;  // Of SemanticMap::segment_of_point, ascending.
  // What it stands on: a segment, and the object that is part of. 0: not known.
  SegmentId supporting_segment = 0;
  ObjectId supporting_object = 0;
};

// The map with a class for every point that has one. The vectors belong to the points of the map
// cloud by index.
struct SemanticMap {
  // As in the segmentation; but where boxes show that a segment holds two things it is two.
  std::vector<SegmentId> segment_of_point;
  std::vector<int> class_of_point;         // kNoClass: background or unknown.
  std::vector<float> confidence_of_point;  // Of the class, or of being background; 0: unknown.
  std::vector<float> entropy_of_point;     // Of its object's or segment's distribution, in [0, 1].
  std::vector<ObjectId> object_of_point;   // 0: none.
  std::vector<SemanticObject> objects;     // By id.
  ClassTable classes;
  ObjectId next_object_id = 1;
};

struct FusionOptions {
  EvidenceOptions evidence;
  double min_confidence = 0.3;  // Of a segment's class.
  std::uint32_t min_views = 2;  // Keyframes that saw it as this class (or all that saw it).
  // Evidence for not knowing: a class (or the background) needs more than that, in a sum over
  // views with one sure detection being 1, so a single weak one does not do.
  double min_evidence = 0.6;
  double min_shared_share = 0.5;  // Parts of one object are under one box in this share of views
  double max_part_gap = 0.04;     // and no farther apart than this, metres, or than
  double max_relative_part_gap = 0.2;  // this share of the larger one's longest side.
  double max_object_shift = 0.15;      // Metres between centroids of one object before and after.
  void Validate() const;               // Throws InputError.
};

// Gives every segment the class that the detections of all keyframes speak for, parts segments that
// hold two things, joins the segments of one thing, and lists the objects (section 3.3 of the
// paper; sums of evidence after Sunderhauf et al., IROS 2017). A pure function of its arguments,
// independent of the order of keyframes: call it again after any correction, with the keyframes'
// present poses. Without keyframes all points are unknown.
//
// `cloud`, `index` and `segmentation` belong together. With `previous`, an object found again keeps
// its id, new ones get ids never used before.
SemanticMap BuildSemanticMap(const MapCloud& cloud,
                             const VoxelIndex& index,
                             const Segmentation& segmentation,
                             std::span<const LabelledKeyframe> keyframes,
                             const ClassTable& classes,
                             const FusionOptions& options,
                             const SemanticMap* previous = nullptr);

}  // namespace semslam

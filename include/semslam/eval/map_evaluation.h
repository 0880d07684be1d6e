// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "semslam/eval/boundary_score.h"
#include "semslam/eval/clip_truth.h"
#include "semslam/eval/label_score.h"
#include "semslam/eval/object_score.h"
#include "semslam/eval/segmentation_score.h"
#include "semslam/eval/surface_match.h"
#include "semslam/eval/trajectory_error.h"
#include "semslam/io/objects_io.h"
#include "semslam/io/trajectory_io.h"

namespace semslam {

// What a run of rgbd_tum left in its output folder.
struct MapResult {
  Trajectory trajectory;
  std::vector<Eigen::Vector3f> positions;  // In the run's own world.
  std::vector<std::uint32_t> segments;     // By point; 0: none.
  std::vector<std::uint32_t> labels;       // By point; labels of the class table, 0: none.
  std::vector<ClassRecord> classes;
  std::vector<ObjectRecord> objects;
};

// Reads CameraTrajectory.txt, segmentation.pcd, semantic_map.pcd and objects.json. Throws
// InputError that names the file, also if the two clouds do not have the same points.
MapResult ReadMapResult(const std::filesystem::path& folder);

struct MapEvaluationOptions {
  // Classes to evaluate; names as ClassTable::Find understands them. Empty: those that the clip's
  // instances and the result's class table share.
  std::vector<std::string> classes;
  // Shares of its box's best seen face, and samples, from which on an object has to be found.
  double min_seen_share = 0.3;
  std::size_t min_seen_samples = 50;
  double bleeding_reach = 0.3;                     // Metres.
  std::vector<double> box_overlaps = {0.25, 0.5};  // Of objects, intersection over union.
  TrajectoryErrorOptions trajectory;
  SurfaceMatchOptions surface;
  BoundaryOptions boundaries;
  void Validate() const;  // Throws std::invalid_argument.
};

// How well the points' classes are those of the surfaces they lie on; points off the surface are
// wrong, whatever they carry.
struct LabelEvaluation {
  LabelScore labels;
  BleedingScore bleeding;
};

struct MapEvaluation {
  TrajectoryError trajectory;
  SurfaceMatch surface;
  // True region of each point, as RegionOfInstance numbers it; 0 for points off the surface, which
  // the measures of the segments leave out.
  std::vector<std::uint32_t> region_of_point;
  SegmentationScore segmentation;
  BoundaryScore boundaries;
  std::vector<RegionScore> regions;

  std::vector<std::string> classes;  // That were evaluated; the numbers below count from 1.
  LabelScore labels;
  BleedingScore bleeding;
  // Box and centroid of the part that was seen: a map cannot hold more. Boxes, also those of the
  // found objects, are at least 1 cm thick.
  std::vector<ScoredObject> true_objects;
  std::vector<double> seen_shares;          // Of the true objects.
  std::vector<ScoredObject> found_objects;  // In the frame of the truth.
  std::vector<ObjectScore> objects;         // One for each of box_overlaps.
};

// Compares a map with the truth. The alignment of the estimated with the true trajectory carries
// the map into the world of the truth; each point then belongs to the instance of the nearest
// sample of the true surface. The measures do not change (but for rounding of the points'
// coordinates) if the whole result is moved. Throws InputError if the trajectories cannot be
// aligned, or for a class that neither has.
MapEvaluation EvaluateMap(const ClipTruth& truth,
                          const MapResult& result,
                          const MapEvaluationOptions& options = {});

// The same measures for other labels of the result's points, as baselines give them; `evaluation`
// is that of the result with the same options.
LabelEvaluation EvaluateLabels(const ClipTruth& truth,
                               const MapResult& result,
                               const std::vector<std::uint32_t>& labels,
                               const MapEvaluation& evaluation,
                               const MapEvaluationOptions& options = {});

}  // namespace semslam

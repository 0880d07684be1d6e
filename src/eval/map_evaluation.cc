// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/eval/map_evaluation.h"

#include <algorithm>
#include <stdexcept>

#include "semslam/base/check.h"

#include "eval/class_numbers.h"

namespace semslam {
namespace {

std::vector<Eigen::Vector3f> Moved(const Rigid3& T_truth_estimate,
                                   const std::vector<Eigen::Vector3f>& points) {
  std::vector<Eigen::Vector3f> moved;
  moved.reserve(points.size());
  for (const Eigen::Vector3f& point : points) {
    moved.push_back((T_truth_estimate * point.cast<double>()).cast<float>());
  }
  return moved;
}

// Segments against what geometry can tell apart.
void MeasureSegments(const ClipTruth& truth,
                     const MapResult& result,
                     const std::vector<Eigen::Vector3f>& positions,
                     const BoundaryOptions& options,
                     MapEvaluation& evaluation) {
  const std::map<std::uint32_t, std::uint32_t> region_of_instance = RegionOfInstance(truth);
  std::vector<std::uint32_t>& regions = evaluation.region_of_point;
  regions.reserve(positions.size());
  for (const std::uint32_t instance : evaluation.surface.instance_of_point) {
    regions.push_back(instance == SurfaceMatch::kOffSurface ? 0 : region_of_instance.at(instance));
  }
  evaluation.segmentation = ScoreSegmentation(result.segments, regions);
  evaluation.regions = ScoreRegions(result.segments, regions);
  evaluation.boundaries = ScoreBoundaries(positions, result.segments, regions, options);
}

LabelEvaluation MeasureLabels(const ClipTruth& truth,
                              const std::vector<std::uint32_t>& labels,
                              const std::vector<Eigen::Vector3f>& positions,
                              const SurfaceMatch& surface,
                              const ClassNumbers& numbers,
                              double bleeding_reach) {
  std::vector<std::uint32_t> found;
  std::vector<std::uint32_t> expected;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const std::uint32_t instance = surface.instance_of_point[i];
    found.push_back(numbers.OfLabel(labels[i]));
    expected.push_back(instance == SurfaceMatch::kOffSurface ? kNothingThere
                                                             : numbers.OfInstance(instance));
  }
  std::vector<Eigen::Vector3f> object_points;
  std::vector<std::uint32_t> object_classes;
  for (std::size_t i = 0; i < truth.positions.size(); ++i) {
    const std::uint32_t number = numbers.OfInstance(truth.instance_of_sample[i]);
    if (number == kNoClassNumber) continue;
    object_points.push_back(truth.positions[i]);
    object_classes.push_back(number);
  }
  const auto num_classes = static_cast<std::uint32_t>(numbers.names().size());
  return {.labels = ScoreLabels(found, expected, num_classes),
          .bleeding = MeasureBleeding(positions, found, expected, object_points, object_classes,
                                      bleeding_reach)};
}

// Boxes of flat things have no volume to compare; what is thinner than the map can tell is
// thickened.
OrientedBox Thickened(OrientedBox box) {
  constexpr double kMinSize = 0.01;  // Metres.
  box.half_size = box.half_size.cwiseMax(0.5 * kMinSize);
  return box;
}

void MeasureObjects(const ClipTruth& truth,
                    const MapResult& result,
                    const ClassNumbers& numbers,
                    const MapEvaluationOptions& options,
                    MapEvaluation& evaluation) {
  for (const InstanceRecord& instance : truth.instances) {
    const std::uint32_t number = numbers.OfInstance(instance.id);
    if (number == kNoClassNumber) continue;
    const SeenPart part = FindSeenPart(truth, instance);
    if (part.num_samples == 0) continue;
    const bool counts =
        part.seen_share >= options.min_seen_share && part.num_samples >= options.min_seen_samples;
    evaluation.true_objects.push_back(
        {instance.id, number, Thickened(part.box), part.centroid, counts});
    evaluation.seen_shares.push_back(part.seen_share);
  }
  const Rigid3& T_truth_estimate = evaluation.trajectory.T_truth_estimate_map;
  for (const ObjectRecord& object : result.objects) {
    const std::uint32_t number = numbers.OfLabel(object.label);
    if (number == kNoClassNumber) continue;
    OrientedBox box = Thickened(object.box);
    box.T_world_box = T_truth_estimate * box.T_world_box;
    evaluation.found_objects.push_back(
        {object.id, number, box, T_truth_estimate * object.centroid, true});
  }
  for (const double overlap : options.box_overlaps) {
    evaluation.objects.push_back(
        ScoreObjects(evaluation.true_objects, evaluation.found_objects, overlap));
  }
}

}  // namespace

void MapEvaluationOptions::Validate() const {
  trajectory.Validate();
  surface.Validate();
  boundaries.Validate();
  if (!(bleeding_reach > 0)) throw std::invalid_argument("bleeding_reach must be positive");
  for (const double overlap : box_overlaps) {
    if (!(overlap > 0 && overlap <= 1)) throw std::invalid_argument("overlaps must be in (0, 1]");
  }
}

MapEvaluation EvaluateMap(const ClipTruth& truth,
                          const MapResult& result,
                          const MapEvaluationOptions& options) {
  options.Validate();
  SEMSLAM_CHECK(result.segments.size() == result.positions.size());
  SEMSLAM_CHECK(result.labels.size() == result.positions.size());
  const ClassNumbers numbers(truth.instances, result.classes, options.classes);
  MapEvaluation evaluation;
  evaluation.trajectory =
      EvaluateTrajectory(truth.trajectory, result.trajectory, options.trajectory);
  const std::vector<Eigen::Vector3f> positions =
      Moved(evaluation.trajectory.T_truth_estimate_map, result.positions);
  evaluation.surface = MatchToSurface(positions, truth.Surface(), options.surface);
  evaluation.classes = numbers.names();
  MeasureSegments(truth, result, positions, options.boundaries, evaluation);
  const LabelEvaluation labels = MeasureLabels(truth, result.labels, positions, evaluation.surface,
                                               numbers, options.bleeding_reach);
  evaluation.labels = labels.labels;
  evaluation.bleeding = labels.bleeding;
  MeasureObjects(truth, result, numbers, options, evaluation);
  return evaluation;
}

LabelEvaluation EvaluateLabels(const ClipTruth& truth,
                               const MapResult& result,
                               const std::vector<std::uint32_t>& labels,
                               const MapEvaluation& evaluation,
                               const MapEvaluationOptions& options) {
  SEMSLAM_CHECK(labels.size() == result.positions.size());
  SEMSLAM_CHECK(labels.size() == evaluation.surface.instance_of_point.size());
  const ClassNumbers numbers(truth.instances, result.classes, options.classes);
  return MeasureLabels(truth, labels,
                       Moved(evaluation.trajectory.T_truth_estimate_map, result.positions),
                       evaluation.surface, numbers, options.bleeding_reach);
}

}  // namespace semslam

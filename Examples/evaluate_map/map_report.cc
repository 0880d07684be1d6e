// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "map_report.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <nlohmann/json.hpp>

#include "format_line.h"
#include "printable.h"

namespace {

using semslam::ClassScore;
using semslam::ClipTruth;
using semslam::InstanceRecord;
using semslam::MapEvaluation;
using semslam::ObjectMatch;
using semslam::ObjectScore;
using semslam::RegionScore;
using semslam::ScoredObject;
using Json = nlohmann::ordered_json;

// "0.873", or "-" if it is a share of nothing.
std::string Share(double value) { return std::isnan(value) ? "-" : Line("%.3f", value); }
std::string Millimetres(double metres) {
  return std::isnan(metres) ? "-" : Line("%.1f mm", 1e3 * metres);
}

double OffSurfaceShare(const MapEvaluation& evaluation) {
  const std::size_t num_points = evaluation.surface.instance_of_point.size();
  return num_points == 0 ? 0.0
                         : static_cast<double>(evaluation.surface.num_off_surface) /
                               static_cast<double>(num_points);
}

std::string ClassOf(const ClipTruth& truth, std::uint32_t instance) {
  for (const InstanceRecord& record : truth.instances) {
    if (record.id == instance) return Printable(record.class_name);
  }
  return "";
}

const RegionScore* FindRegion(const MapEvaluation& evaluation, std::uint32_t region) {
  for (const RegionScore& score : evaluation.regions) {
    if (score.region == region) return &score;
  }
  return nullptr;
}

const ObjectMatch* FindMatch(const MapEvaluation& evaluation, std::size_t true_index) {
  if (evaluation.objects.empty()) return nullptr;
  for (const ObjectMatch& match : evaluation.objects.front().matches) {
    if (match.true_index == true_index) return &match;
  }
  return nullptr;
}

std::string GeometryTable(const MapEvaluation& evaluation) {
  const auto& trajectory = evaluation.trajectory;
  const auto& surface = evaluation.surface;
  std::string table;
  table +=
      Line("trajectory     ATE rmse %.4f m  max %.4f m  (%d of %d poses)", trajectory.absolute.rmse,
           trajectory.absolute.max, trajectory.num_pairs, trajectory.num_estimates);
  if (trajectory.num_relative_pairs > 0) {
    table += Line("  RPE over 1 s %.4f m  %.3f deg", trajectory.relative_translation_rmse,
                  trajectory.relative_rotation_rmse_degrees);
  }
  table +=
      Line("\nsurface        %zu points  error median %s  p95 %s  off surface %s  complete %s\n",
           surface.instance_of_point.size(), Millimetres(surface.MedianDistance()).c_str(),
           Millimetres(surface.Quantile(0.95)).c_str(), Share(OffSurfaceShare(evaluation)).c_str(),
           Share(surface.completeness).c_str());
  const auto& segmentation = evaluation.segmentation;
  table += Line(
      "segmentation   ARI %.3f  over %.3f  under %.3f  coverage %.3f  %zu segments of %zu "
      "surfaces\n",
      segmentation.adjusted_rand_index, segmentation.over_segmentation,
      segmentation.under_segmentation, segmentation.coverage, segmentation.num_segments,
      segmentation.num_regions);
  table += Line("boundaries     recall %.3f  precision %.3f  (3 cm)\n",
                evaluation.boundaries.recall, evaluation.boundaries.precision);
  return table;
}

std::string LabelTable(const MapEvaluation& evaluation) {
  if (evaluation.classes.empty()) {
    return "labels         none: the result's class table and the clip share no class\n";
  }
  const auto& labels = evaluation.labels;
  std::string table = Line(
      "labels         accuracy on objects %s  over all %s  mean IoU %s  bleeding %s of %zu "
      "points\n",
      Share(labels.ObjectAccuracy()).c_str(), Share(labels.Accuracy()).c_str(),
      Share(labels.MeanIntersectionOverUnion()).c_str(), Share(evaluation.bleeding.Share()).c_str(),
      evaluation.bleeding.num_points);
  for (const ObjectScore& score : evaluation.objects) {
    table += Line(
        "objects %.2f   precision %s  recall %s  class accuracy %s  centroid error %s  (%zu true, "
        "%zu found)\n",
        score.min_overlap, Share(score.Precision()).c_str(), Share(score.Recall()).c_str(),
        Share(score.ClassAccuracy()).c_str(), Millimetres(score.MedianCentroidError()).c_str(),
        score.num_true, score.num_found);
  }
  table += Line("\n%-16s %9s %9s %9s %9s\n", "class", "points", "precision", "recall", "IoU");
  for (std::size_t i = 0; i < evaluation.classes.size(); ++i) {
    const ClassScore& score = labels.classes[i];
    table += Line("%-16s %9zu %9s %9s %9s\n", Printable(evaluation.classes[i]).c_str(),
                  score.num_true, Share(score.Precision()).c_str(), Share(score.Recall()).c_str(),
                  Share(score.IntersectionOverUnion()).c_str());
  }
  return table;
}

// One line for each true object: how well its best segment and its best found object fit.
std::string ObjectTable(const MapEvaluation& evaluation, const ClipTruth& truth) {
  if (evaluation.true_objects.empty()) return "";
  std::string table = Line("\n%-22s %5s %8s %8s %8s  %-20s %5s %9s\n", "object", "seen", "points",
                           "segment", "foreign", "found as", "IoU", "centroid");
  for (std::size_t i = 0; i < evaluation.true_objects.size(); ++i) {
    const ScoredObject& object = evaluation.true_objects[i];
    const RegionScore* region = FindRegion(evaluation, object.id);
    const ObjectMatch* match = FindMatch(evaluation, i);
    const std::string name = std::to_string(object.id) + " " + ClassOf(truth, object.id);
    table +=
        Line("%-22s %5.2f%c", name.c_str(), evaluation.seen_shares[i], object.counts ? ' ' : '*');
    table += region == nullptr
                 ? Line("%8s %8s %8s", "0", "-", "-")
                 : Line("%8zu %8.3f %8.3f", region->num_points, region->covered, region->foreign);
    if (match == nullptr) {
      table += Line("  %-20s %5s %9s\n", "-", "-", "-");
      continue;
    }
    const ScoredObject& found = evaluation.found_objects[match->found_index];
    const std::string found_name =
        std::to_string(found.id) + " " + Printable(evaluation.classes[found.class_number - 1]);
    table += Line("  %-20s %5.2f %9s\n", found_name.c_str(), match->overlap,
                  Millimetres(match->centroid_error).c_str());
  }
  return table +
         "segment: share of the object's points in its best segment; foreign: share of that "
         "segment from elsewhere; *: too little seen to count\n";
}

std::string BaselineTable(const MapEvaluation& evaluation, const std::vector<Baseline>& baselines) {
  if (baselines.empty()) return "";
  std::string table =
      Line("\n%-24s %10s %9s %9s\n", "labels by", "on objects", "mean IoU", "bleeding");
  const auto row = [](const std::string& name, const semslam::LabelEvaluation& labels) {
    return Line("%-24s %10s %9s %9s\n", name.c_str(), Share(labels.labels.ObjectAccuracy()).c_str(),
                Share(labels.labels.MeanIntersectionOverUnion()).c_str(),
                Share(labels.bleeding.Share()).c_str());
  };
  for (const Baseline& baseline : baselines) table += row(baseline.name, baseline.evaluation);
  return table + row("this map", {evaluation.labels, evaluation.bleeding});
}

Json ToJson(const semslam::TrajectoryError& error) {
  return {{"num_estimates", error.num_estimates},
          {"num_pairs", error.num_pairs},
          {"ate_rmse_m", error.absolute.rmse},
          {"ate_max_m", error.absolute.max},
          {"rpe_1s_translation_rmse_m", error.relative_translation_rmse},
          {"rpe_1s_rotation_rmse_deg", error.relative_rotation_rmse_degrees}};
}

Json ToJson(const RegionScore& region, const ClipTruth& truth) {
  return {{"instance", region.region},       {"class", ClassOf(truth, region.region)},
          {"num_points", region.num_points}, {"best_segment", region.best_segment},
          {"covered", region.covered},       {"foreign", region.foreign}};
}

Json SegmentationJson(const MapEvaluation& evaluation, const ClipTruth& truth) {
  const auto& score = evaluation.segmentation;
  Json json = {{"adjusted_rand_index", score.adjusted_rand_index},
               {"over_segmentation", score.over_segmentation},
               {"under_segmentation", score.under_segmentation},
               {"coverage", score.coverage},
               {"boundary_recall", evaluation.boundaries.recall},
               {"boundary_precision", evaluation.boundaries.precision},
               {"num_points", score.num_points},
               {"num_segments", score.num_segments},
               {"num_regions", score.num_regions},
               {"regions", Json::array()}};
  for (const RegionScore& region : evaluation.regions) {
    json["regions"].push_back(ToJson(region, truth));
  }
  return json;
}

Json LabelsJson(const semslam::LabelEvaluation& evaluation) {
  const auto& labels = evaluation.labels;
  return {{"accuracy_on_objects", labels.ObjectAccuracy()},
          {"accuracy", labels.Accuracy()},
          {"mean_iou", labels.MeanIntersectionOverUnion()},
          {"bleeding", evaluation.bleeding.Share()},
          {"num_points_near_objects", evaluation.bleeding.num_points}};
}

Json LabelsJson(const MapEvaluation& evaluation, const std::vector<Baseline>& baselines) {
  const auto& labels = evaluation.labels;
  Json json = LabelsJson({labels, evaluation.bleeding});
  json["classes"] = Json::array();
  for (std::size_t i = 0; i < evaluation.classes.size(); ++i) {
    const ClassScore& score = labels.classes[i];
    json["classes"].push_back({{"name", evaluation.classes[i]},
                               {"num_true", score.num_true},
                               {"num_found", score.num_found},
                               {"precision", score.Precision()},
                               {"recall", score.Recall()},
                               {"iou", score.IntersectionOverUnion()}});
  }
  for (const Baseline& baseline : baselines) {
    json["baselines"][baseline.name] = LabelsJson(baseline.evaluation);
  }
  return json;
}

Json ToJson(const ObjectScore& score, const MapEvaluation& evaluation) {
  Json json = {{"min_iou", score.min_overlap},
               {"num_true", score.num_true},
               {"num_found", score.num_found},
               {"num_matched", score.matches.size()},
               {"precision", score.Precision()},
               {"recall", score.Recall()},
               {"class_accuracy", score.ClassAccuracy()},
               {"centroid_error_median_m", score.MedianCentroidError()},
               {"matches", Json::array()}};
  for (const ObjectMatch& match : score.matches) {
    const ScoredObject& object = evaluation.true_objects[match.true_index];
    const ScoredObject& found = evaluation.found_objects[match.found_index];
    json["matches"].push_back({{"instance", object.id},
                               {"class", evaluation.classes[object.class_number - 1]},
                               {"object", found.id},
                               {"found_class", evaluation.classes[found.class_number - 1]},
                               {"iou", match.overlap},
                               {"centroid_error_m", match.centroid_error}});
  }
  return json;
}

}  // namespace

std::string MapTable(const MapEvaluation& evaluation,
                     const ClipTruth& truth,
                     const std::vector<Baseline>& baselines) {
  return GeometryTable(evaluation) + LabelTable(evaluation) + ObjectTable(evaluation, truth) +
         BaselineTable(evaluation, baselines);
}

std::string MapJson(const MapEvaluation& evaluation,
                    const ClipTruth& truth,
                    const std::vector<Baseline>& baselines) {
  const auto& surface = evaluation.surface;
  Json json = {{"trajectory", ToJson(evaluation.trajectory)},
               {"surface",
                {{"num_points", surface.instance_of_point.size()},
                 {"num_off_surface", surface.num_off_surface},
                 {"error_median_m", surface.MedianDistance()},
                 {"error_p95_m", surface.Quantile(0.95)},
                 {"completeness", surface.completeness}}},
               {"segmentation", SegmentationJson(evaluation, truth)},
               {"labels", LabelsJson(evaluation, baselines)},
               {"objects", Json::array()}};
  for (const ObjectScore& score : evaluation.objects) {
    json["objects"].push_back(ToJson(score, evaluation));
  }
  constexpr int kIndent = 2;
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "semslam/segmentation/segmenter.h"

namespace semslam {
namespace {

void Require(bool is_good, const std::string& field, double value, const std::string& expected) {
  if (is_good) return;
  std::ostringstream text;
  text << field << ": expected " << expected << ", found " << value;
  throw std::invalid_argument(text.str());
}

void RequirePositive(const std::string& field, double value) {
  Require(value > 0 && std::isfinite(value), field, value, "a number > 0");
}

void RequireNotNegative(const std::string& field, double value) {
  Require(value >= 0 && std::isfinite(value), field, value, "a number >= 0");
}

void RequireFraction(const std::string& field, double value) {
  Require(value >= 0 && value <= 1, field, value, "a number from 0 to 1");
}

void Check(const SupervoxelOptions& options) {
  RequirePositive("supervoxels.voxel_size", options.voxel_size);
  Require(options.max_voxel_growth >= 1, "supervoxels.max_voxel_growth", options.max_voxel_growth,
          "a number >= 1");
  Require(options.seed_spacing >= options.voxel_size && std::isfinite(options.seed_spacing),
          "supervoxels.seed_spacing", options.seed_spacing, "the size of a voxel at least");
  RequireNotNegative("supervoxels.spatial_weight", options.spatial_weight);
  RequireNotNegative("supervoxels.normal_weight", options.normal_weight);
  RequireNotNegative("supervoxels.offset_weight", options.offset_weight);
  RequireNotNegative("supervoxels.offset_tolerance", options.offset_tolerance);
  Require(options.num_passes >= 1, "supervoxels.num_passes", options.num_passes, "1 at least");
}

void Check(const PlaneHypothesisOptions& options) {
  RequirePositive("planes.tolerance", options.tolerance);
  RequirePositive("planes.min_area", options.min_area);
  RequireFraction("planes.min_normal_cosine", options.min_normal_cosine);
  RequireNotNegative("planes.max_variation", options.max_variation);
  RequireNotNegative("planes.max_ransac_planes", options.max_ransac_planes);
  RequireNotNegative("planes.num_ransac_trials", options.num_ransac_trials);
  RequirePositive("planes.merge_angle", options.merge_angle);
  RequirePositive("planes.merge_distance", options.merge_distance);
}

void Check(const PlaneSelectionOptions& options) {
  RequirePositive("selection.initial_lambda", options.initial_lambda);
  Require(options.max_lambda_change > 1, "selection.max_lambda_change", options.max_lambda_change,
          "a number > 1");
  RequireFraction("selection.min_reduction_ratio", options.min_reduction_ratio);
  RequireNotNegative("selection.num_restarts", options.num_restarts);
  RequireNotNegative("selection.max_iterations", options.max_iterations);
}

void Check(const PlaneAssignmentOptions& options) {
  RequireNotNegative("assignment.no_plane_cost", options.no_plane_cost);
  RequireNotNegative("assignment.smoothness", options.smoothness);
  RequireFraction("assignment.min_smooth_cosine", options.min_smooth_cosine);
  RequireNotNegative("assignment.max_sweeps", options.max_sweeps);
}

void Check(const ReliefOptions& options) {
  RequirePositive("relief.min_height", options.min_height);
  RequireNotNegative("relief.noise_factor", options.noise_factor);
  RequirePositive("relief.min_rim_height", options.min_rim_height);
  RequireNotNegative("relief.rim_noise_factor", options.rim_noise_factor);
  RequireNotNegative("relief.max_rim", options.max_rim);
  RequirePositive("relief.reference_radius", options.reference_radius);
  RequireNotNegative("relief.min_area", options.min_area);
}

void Check(const ComponentOptions& options) {
  RequireNotNegative("components.concavity_tolerance", options.concavity_tolerance);
  RequireNotNegative("components.step_tolerance", options.step_tolerance);
  RequireNotNegative("components.min_structural_area", options.min_structural_area);
  RequireNotNegative("components.min_thing_area", options.min_thing_area);
  RequireNotNegative("components.max_part_gap", options.max_part_gap);
  RequireNotNegative("components.min_resting_share", options.min_resting_share);
  RequireNotNegative("components.min_area", options.min_area);
  RequireNotNegative("components.min_piece_area", options.min_piece_area);
  RequireNotNegative("components.max_gap", options.max_gap);
  RequireNotNegative("components.flush_tolerance", options.flush_tolerance);
  RequireNotNegative("components.min_core_area", options.min_core_area);
  RequireNotNegative("components.warp_tolerance", options.warp_tolerance);
}

}  // namespace

void Segmenter::Options::Validate() const {
  Check(supervoxels);
  Check(planes);
  Check(selection);
  Check(assignment);
  Check(relief);
  Check(components);
  Require(num_threads >= 0, "num_threads", num_threads, "0 or more");
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/eval/trajectory_error.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "semslam/base/check.h"
#include "semslam/base/error.h"
#include "semslam/geometry/alignment.h"

namespace semslam {
namespace {

struct PosePair {
  TimeNs time = 0;  // Of the estimate.
  Rigid3 T_truth;
  Rigid3 T_estimate;
};

bool IsEarlier(const TimedPose& a, const TimedPose& b) { return a.time < b.time; }

// The pose nearest in time; the earlier one of two at the same distance.
const TimedPose& Nearest(const Trajectory& trajectory, TimeNs time) {
  const auto after =
      std::upper_bound(trajectory.begin(), trajectory.end(), time,
                       [](TimeNs t, const TimedPose& pose) { return t < pose.time; });
  if (after == trajectory.begin()) return *after;
  const auto before = std::prev(after);
  if (after == trajectory.end()) return *before;
  return after->time - time < time - before->time ? *after : *before;
}

std::vector<PosePair> Associate(const Trajectory& truth,
                                const Trajectory& estimate,
                                TimeNs max_time_difference) {
  std::vector<PosePair> pairs;
  if (truth.empty()) return pairs;
  for (const TimedPose& pose : estimate) {
    const TimedPose& nearest = Nearest(truth, pose.time);
    if (std::abs(nearest.time - pose.time) >= max_time_difference) continue;
    pairs.push_back({pose.time, nearest.T_world_camera, pose.T_world_camera});
  }
  return pairs;
}

Rigid3 Align(const std::vector<PosePair>& pairs) {
  std::vector<Eigen::Vector3d> truth;
  std::vector<Eigen::Vector3d> estimate;
  for (const PosePair& pair : pairs) {
    truth.push_back(pair.T_truth.translation);
    estimate.push_back(pair.T_estimate.translation);
  }
  const std::optional<Rigid3> T_truth_estimate = AlignPoints(truth, estimate);
  if (!T_truth_estimate) {
    throw InputError("trajectories cannot be aligned: the " + std::to_string(pairs.size()) +
                     " common positions lie on one line or in one point");
  }
  return *T_truth_estimate;
}

// By the camera's centre and a point 1 m away along each of its axes.
Rigid3 AlignPoses(const std::vector<PosePair>& pairs) {
  std::vector<Eigen::Vector3d> truth;
  std::vector<Eigen::Vector3d> estimate;
  for (const PosePair& pair : pairs) {
    for (const Eigen::Vector3d& p_camera : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0),
                                            Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1)}) {
      truth.push_back(pair.T_truth * p_camera);
      estimate.push_back(pair.T_estimate * p_camera);
    }
  }
  const std::optional<Rigid3> T_truth_estimate = AlignPoints(truth, estimate);
  SEMSLAM_CHECK(T_truth_estimate.has_value()) << pairs.size() << " poses";
  return *T_truth_estimate;
}

double RootMeanSquare(const std::vector<double>& values) {
  if (values.empty()) return 0.0;
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

TrajectoryError::Distances Summarize(std::vector<double> distances) {
  TrajectoryError::Distances summary;
  summary.rmse = RootMeanSquare(distances);
  for (const double distance : distances) summary.mean += distance;
  summary.mean /= static_cast<double>(distances.size());
  std::sort(distances.begin(), distances.end());
  const std::size_t half = distances.size() / 2;
  summary.median =
      distances.size() % 2 == 1 ? distances[half] : 0.5 * (distances[half - 1] + distances[half]);
  summary.max = distances.back();
  return summary;
}

void MeasureAbsolute(const std::vector<PosePair>& pairs, TrajectoryError& error) {
  error.T_truth_estimate = Align(pairs);
  error.T_truth_estimate_map = AlignPoses(pairs);
  std::vector<double> distances;
  for (const PosePair& pair : pairs) {
    const Eigen::Vector3d& p_truth = pair.T_truth.translation;
    distances.push_back((error.T_truth_estimate * pair.T_estimate.translation - p_truth).norm());
    error.poses.push_back({pair.time, p_truth, distances.back()});
  }
  error.absolute = Summarize(std::move(distances));
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    error.path_length += (pairs[i].T_truth.translation - pairs[i - 1].T_truth.translation).norm();
  }
}

// The motion from each pose to the first one that is more than the interval later, if that is not
// much later.
void MeasureRelative(const std::vector<PosePair>& pairs,
                     const TrajectoryErrorOptions& options,
                     TrajectoryError& error) {
  std::vector<double> translations;
  std::vector<double> rotations;
  std::size_t later = 0;
  for (const PosePair& pair : pairs) {
    const TimeNs time = pair.time + options.relative_interval;
    while (later < pairs.size() && pairs[later].time <= time) ++later;
    if (later == pairs.size()) break;
    if (pairs[later].time - time > options.relative_interval_tolerance) continue;
    const Rigid3 true_motion = pair.T_truth.Inverse() * pairs[later].T_truth;
    const Rigid3 motion = pair.T_estimate.Inverse() * pairs[later].T_estimate;
    const Rigid3 difference = true_motion.Inverse() * motion;
    translations.push_back(difference.translation.norm());
    rotations.push_back(LogSO3(difference.rotation).norm());
  }
  constexpr double kDegrees = 180.0 / 3.14159265358979323846;
  error.num_relative_pairs = static_cast<int>(translations.size());
  error.relative_translation_rmse = RootMeanSquare(translations);
  error.relative_rotation_rmse_degrees = kDegrees * RootMeanSquare(rotations);
}

}  // namespace

void TrajectoryErrorOptions::Validate() const {
  if (max_time_difference <= 0 || relative_interval <= 0 || relative_interval_tolerance < 0) {
    throw std::invalid_argument("times of the trajectory error must be positive");
  }
}

TrajectoryError EvaluateTrajectory(const Trajectory& truth,
                                   const Trajectory& estimate,
                                   const TrajectoryErrorOptions& options) {
  options.Validate();
  SEMSLAM_CHECK(std::is_sorted(truth.begin(), truth.end(), IsEarlier)) << "truth";
  SEMSLAM_CHECK(std::is_sorted(estimate.begin(), estimate.end(), IsEarlier)) << "estimate";
  const std::vector<PosePair> pairs = Associate(truth, estimate, options.max_time_difference);
  constexpr std::size_t kMinPairs = 3;
  if (pairs.size() < kMinPairs) {
    throw InputError("expected at least 3 estimated poses with a true pose within " +
                     FormatTime(options.max_time_difference, 3) + " s, found " +
                     std::to_string(pairs.size()) + " of " + std::to_string(estimate.size()) +
                     " (" + std::to_string(truth.size()) + " true poses)");
  }
  TrajectoryError error;
  error.num_estimates = static_cast<int>(estimate.size());
  error.num_pairs = static_cast<int>(pairs.size());
  MeasureAbsolute(pairs, error);
  MeasureRelative(pairs, options, error);
  return error;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/level_frame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace semslam {

LevelFrame LevelFrameWithUp(const Eigen::Vector3d& up) {
  LevelFrame frame;
  frame.up = up;
  const auto flatten = [&](const Eigen::Vector3d& v) { return v - v.dot(frame.up) * frame.up; };
  frame.forward = flatten(Eigen::Vector3d::UnitZ());
  // The first camera looked straight up or down.
  if (frame.forward.norm() < 0.1) frame.forward = flatten(-Eigen::Vector3d::UnitY());
  frame.forward.normalize();
  frame.right = frame.forward.cross(frame.up);
  return frame;
}

LevelFrame FindLevelFrame(const LabelledMapView& map) {
  if (map.up) return LevelFrameWithUp(map.up->normalized());
  const Eigen::Vector3f camera_up = -Eigen::Vector3f::UnitY();
  return LevelFrameWithUp(
      CommonUpNormal(map.cloud.normals, camera_up).value_or(camera_up).cast<double>());
}

std::optional<Eigen::Vector3f> CommonUpNormal(std::span<const Eigen::Vector3f> normals,
                                              const Eigen::Vector3f& about_up) {
  // Candidates evenly over the sphere (Fibonacci lattice); each normal votes for those within 8
  // degrees. The average of the winner's normals is the answer.
  constexpr int kNumCandidates = 1500;
  const float min_cosine = std::cos(8.0F * 3.14159265F / 180.0F);
  std::vector<Eigen::Vector3f> candidates;
  for (int i = 0; i < kNumCandidates; ++i) {
    const float z = 1.0F - (2.0F * static_cast<float>(i) + 1.0F) / kNumCandidates;
    const double angle = i * 2.399963229728653;  // Golden angle.
    const float radius = std::sqrt(1.0F - z * z);
    const Eigen::Vector3f direction(radius * static_cast<float>(std::cos(angle)),
                                    radius * static_cast<float>(std::sin(angle)), z);
    if (direction.dot(about_up.normalized()) > 0.5F) candidates.push_back(direction);
  }
  constexpr std::size_t kMaxVoters = 20000;
  const std::size_t step = std::max<std::size_t>(1, normals.size() / kMaxVoters);
  std::vector<int> votes(candidates.size());
  std::vector<Eigen::Vector3f> sums(candidates.size(), Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i < normals.size(); i += step) {
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      if (!(normals[i].dot(candidates[k]) > min_cosine)) continue;
      ++votes[k];
      sums[k] += normals[i];
    }
  }
  const auto best = std::max_element(votes.begin(), votes.end());
  constexpr double kMinShare = 0.02;
  const double num_voters = static_cast<double>(normals.size()) / static_cast<double>(step);
  if (best == votes.end() || *best < std::max(1.0, kMinShare * num_voters)) return std::nullopt;
  return sums[static_cast<std::size_t>(best - votes.begin())].normalized();
}

}  // namespace semslam

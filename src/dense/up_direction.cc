// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/dense/up_direction.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace semslam {
namespace {

constexpr float kMinCosine = 0.5F;  // Between up and about_up.

// Evenly over the part of the sphere that may be up (Fibonacci lattice).
std::vector<Eigen::Vector3f> Candidates(const Eigen::Vector3f& about_up) {
  constexpr int kNumOnSphere = 1500;
  constexpr double kGoldenAngle = 2.399963229728653;
  std::vector<Eigen::Vector3f> candidates;
  for (int i = 0; i < kNumOnSphere; ++i) {
    const float z = 1.0F - (2.0F * static_cast<float>(i) + 1.0F) / kNumOnSphere;
    const double angle = i * kGoldenAngle;
    const float radius = std::sqrt(1.0F - z * z);
    const Eigen::Vector3f direction(radius * static_cast<float>(std::cos(angle)),
                                    radius * static_cast<float>(std::sin(angle)), z);
    if (direction.dot(about_up) > kMinCosine) candidates.push_back(direction);
  }
  return candidates;
}

// A camera is rarely tilted by as much as 60 degrees.
float WeightOfTilt(float cosine) { return cosine * cosine * cosine * cosine; }

}  // namespace

std::optional<Eigen::Vector3f> CommonUpNormal(std::span<const Eigen::Vector3f> normals,
                                              const Eigen::Vector3f& about_up) {
  const Eigen::Vector3f camera_up = about_up.normalized();
  const std::vector<Eigen::Vector3f> candidates = Candidates(camera_up);
  // Each normal votes for the candidates within 8 degrees; the average of the winner's normals is
  // the answer.
  const float min_cosine = std::cos(8.0F * std::numbers::pi_v<float> / 180.0F);
  constexpr std::size_t kMaxVoters = 4000;
  const std::size_t step = std::max<std::size_t>(1, normals.size() / kMaxVoters);
  std::vector<float> votes(candidates.size());
  std::vector<Eigen::Vector3f> sums(candidates.size(), Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i < normals.size(); i += step) {
    const float weight = WeightOfTilt(std::max(0.0F, normals[i].dot(camera_up)));
    if (!(weight > 0)) continue;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      if (normals[i].dot(candidates[k]) <= min_cosine) continue;
      votes[k] += weight;
      sums[k] += normals[i];
    }
  }
  const auto best = std::max_element(votes.begin(), votes.end());
  constexpr float kMinShare = 0.02F;
  const float num_voters = static_cast<float>(normals.size()) / static_cast<float>(step);
  if (best == votes.end() || *best <= 0 || *best < kMinShare * num_voters) return std::nullopt;
  return sums[static_cast<std::size_t>(best - votes.begin())].normalized();
}

}  // namespace semslam

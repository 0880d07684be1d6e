// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/geometry/rigid_ransac.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "semslam/base/check.h"
#include "semslam/base/random.h"
#include "semslam/geometry/alignment.h"

namespace semslam {
namespace {

using Agrees = std::function<bool(const Rigid3&, std::size_t)>;
constexpr std::size_t kSampleSize = 3;

std::array<std::size_t, kSampleSize> DrawSample(std::size_t num_pairs, Random& random) {
  std::array<std::size_t, kSampleSize> sample{};
  for (std::size_t i = 0; i < kSampleSize; ++i) {
    const auto drawn = sample.begin() + static_cast<std::ptrdiff_t>(i);
    do {
      sample[i] = random.Index(static_cast<std::uint32_t>(num_pairs));
    } while (std::find(sample.begin(), drawn, sample[i]) != drawn);
  }
  return sample;
}

RigidConsensus Judge(const Rigid3& T_a_b, std::size_t num_pairs, const Agrees& agrees) {
  RigidConsensus result{T_a_b, std::vector<std::uint8_t>(num_pairs, 0), 0};
  for (std::size_t i = 0; i < num_pairs; ++i) {
    if (!agrees(T_a_b, i)) continue;
    result.is_inlier[i] = 1;
    ++result.num_inliers;
  }
  return result;
}

// Samples to be drawn until one is free of outliers with the wanted confidence.
double NumSamplesNeeded(double inlier_share, double confidence) {
  const double all_good = std::pow(inlier_share, static_cast<double>(kSampleSize));
  return all_good >= 1.0 ? 1.0 : std::log(1.0 - confidence) / std::log(1.0 - all_good);
}

// Fits to all that agree, as long as that brings more of them.
RigidConsensus Refine(RigidConsensus best,
                      std::span<const Eigen::Vector3d> points_a,
                      std::span<const Eigen::Vector3d> points_b,
                      const Agrees& agrees) {
  constexpr int kMaxRounds = 5;
  for (int round = 0; round < kMaxRounds; ++round) {
    std::vector<Eigen::Vector3d> a;
    std::vector<Eigen::Vector3d> b;
    for (std::size_t i = 0; i < points_a.size(); ++i) {
      if (best.is_inlier[i] == 0) continue;
      a.push_back(points_a[i]);
      b.push_back(points_b[i]);
    }
    const std::optional<Rigid3> fitted = AlignPoints(a, b);
    if (!fitted) break;
    RigidConsensus judged = Judge(*fitted, points_a.size(), agrees);
    if (judged.num_inliers < best.num_inliers) break;
    const bool is_better = judged.num_inliers > best.num_inliers;
    best = std::move(judged);
    if (!is_better) break;
  }
  return best;
}

}  // namespace

void RansacOptions::Validate() const {
  SEMSLAM_CHECK(confidence > 0 && confidence < 1) << confidence;
  SEMSLAM_CHECK(max_iterations > 0) << max_iterations;
  SEMSLAM_CHECK(min_inliers >= static_cast<int>(kSampleSize)) << min_inliers;
}

std::optional<RigidConsensus> FindRigidConsensus(std::span<const Eigen::Vector3d> points_a,
                                                 std::span<const Eigen::Vector3d> points_b,
                                                 const Agrees& agrees,
                                                 const RansacOptions& options) {
  options.Validate();
  SEMSLAM_CHECK(points_a.size() == points_b.size())
      << points_a.size() << " and " << points_b.size() << " points";
  const std::size_t num_pairs = points_a.size();
  if (num_pairs < static_cast<std::size_t>(options.min_inliers)) return std::nullopt;

  Random random(options.seed);
  RigidConsensus best;
  double num_needed = options.max_iterations;
  for (int i = 0; i < options.max_iterations && i < num_needed; ++i) {
    std::array<Eigen::Vector3d, kSampleSize> a;
    std::array<Eigen::Vector3d, kSampleSize> b;
    const auto sample = DrawSample(num_pairs, random);
    for (std::size_t k = 0; k < kSampleSize; ++k) {
      a[k] = points_a[sample[k]];
      b[k] = points_b[sample[k]];
    }
    const std::optional<Rigid3> T_a_b = AlignPoints(a, b);
    if (!T_a_b) continue;
    RigidConsensus judged = Judge(*T_a_b, num_pairs, agrees);
    if (judged.num_inliers <= best.num_inliers) continue;
    best = std::move(judged);
    num_needed =
        NumSamplesNeeded(best.num_inliers / static_cast<double>(num_pairs), options.confidence);
  }
  if (best.num_inliers < options.min_inliers) return std::nullopt;
  return Refine(std::move(best), points_a, points_b, agrees);
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/plane_selection.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "semslam/base/random.h"

namespace semslam {
namespace {

// Change of the energy per flip of a plane into the set, to first order:
//   a = D + 2 W x.
Eigen::VectorXd Linearise(const SelectionEnergy& energy, const std::vector<bool>& selected) {
  Eigen::VectorXd gradient = energy.unary;
  for (std::size_t i = 0; i < selected.size(); ++i) {
    if (selected[i]) gradient += 2 * energy.pairwise.col(static_cast<Eigen::Index>(i));
  }
  return gradient;
}

// argmin a . x + lambda Hamming(x, x0), plane by plane; ties stay as they are.
std::vector<bool> MinimiseApproximation(const Eigen::VectorXd& gradient,
                                        double lambda,
                                        const std::vector<bool>& start) {
  std::vector<bool> result = start;
  for (std::size_t i = 0; i < start.size(); ++i) {
    const double gain =
        start[i] ? gradient[static_cast<Eigen::Index>(i)] : -gradient[static_cast<Eigen::Index>(i)];
    if (gain > lambda) result[i] = !start[i];
  }
  return result;
}

// The gain of the best single flip of the approximation; none above zero: 0.
double LargestGain(const Eigen::VectorXd& gradient, const std::vector<bool>& selected) {
  double largest = 0;
  for (std::size_t i = 0; i < selected.size(); ++i) {
    const double a = gradient[static_cast<Eigen::Index>(i)];
    largest = std::max(largest, selected[i] ? a : -a);
  }
  return largest;
}

double PredictedReduction(const Eigen::VectorXd& gradient,
                          const std::vector<bool>& from,
                          const std::vector<bool>& to) {
  double reduction = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (from[i] == to[i]) continue;
    const double a = gradient[static_cast<Eigen::Index>(i)];
    reduction += from[i] ? a : -a;
  }
  return reduction;
}

}  // namespace

double EnergyOf(const SelectionEnergy& energy, const std::vector<bool>& selected) {
  double sum = 0;
  for (std::size_t i = 0; i < selected.size(); ++i) {
    if (!selected[i]) continue;
    const auto m = static_cast<Eigen::Index>(i);
    sum += energy.unary[m];
    for (std::size_t j = 0; j < i; ++j) {
      if (selected[j]) sum += 2 * energy.pairwise(m, static_cast<Eigen::Index>(j));
    }
  }
  return sum;
}

std::vector<bool> LsaTr(const SelectionEnergy& energy,
                        std::vector<bool> start,
                        const PlaneSelectionOptions& options) {
  std::vector<bool> current = std::move(start);
  double current_energy = EnergyOf(energy, current);
  double lambda = options.initial_lambda;
  for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
    const Eigen::VectorXd gradient = Linearise(energy, current);
    std::vector<bool> next = MinimiseApproximation(gradient, lambda, current);
    if (next == current) {
      // The largest lambda that changes something lies just below the largest gain.
      const double gain = LargestGain(gradient, current);
      if (gain <= 0) break;
      lambda = std::max(0.0, gain * (1 - 1e-9));
      next = MinimiseApproximation(gradient, lambda, current);
      if (next == current) break;
      // W has a zero diagonal, so that for a single flip the approximation is exact.
    }
    const double next_energy = EnergyOf(energy, next);
    const double predicted = PredictedReduction(gradient, current, next);
    const double actual = current_energy - next_energy;
    const double ratio = predicted > 0 ? actual / predicted : 0.0;
    if (actual > 0) {
      current = std::move(next);
      current_energy = next_energy;
    }
    lambda = ratio < options.min_reduction_ratio ? lambda * options.max_lambda_change
                                                 : lambda / options.max_lambda_change;
  }
  return current;
}

std::vector<bool> SelectGreedily(const SelectionEnergy& energy) {
  const Eigen::Index size = energy.unary.size();
  std::vector<bool> selected(static_cast<std::size_t>(size), false);
  Eigen::VectorXd change = energy.unary;  // Of the energy, if the plane is added.
  while (true) {
    Eigen::Index best = -1;
    for (Eigen::Index m = 0; m < size; ++m) {
      if (selected[static_cast<std::size_t>(m)] || change[m] >= 0) continue;
      if (best < 0 || change[m] < change[best]) best = m;
    }
    if (best < 0) return selected;
    selected[static_cast<std::size_t>(best)] = true;
    change += 2 * energy.pairwise.col(best);
  }
}

std::vector<bool> SelectPlanes(const SelectionEnergy& energy,
                               const PlaneSelectionOptions& options) {
  const auto size = static_cast<std::size_t>(energy.unary.size());
  std::vector<std::vector<bool>> starts = {std::vector<bool>(size, true), SelectGreedily(energy)};
  Random random(options.seed);
  for (int restart = 0; restart < options.num_restarts; ++restart) {
    std::vector<bool>& start = starts.emplace_back(size);
    for (std::size_t i = 0; i < size; ++i) start[i] = random.Uniform() < 0.5;
  }
  std::vector<bool> best;
  double best_energy = std::numeric_limits<double>::infinity();
  for (const std::vector<bool>& start : starts) {
    std::vector<bool> selected = LsaTr(energy, start, options);
    const double reached = EnergyOf(energy, selected);
    if (reached >= best_energy) continue;
    best_energy = reached;
    best = std::move(selected);
  }
  return best;
}

}  // namespace semslam

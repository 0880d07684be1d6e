// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/belief.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "semslam/base/check.h"

namespace semslam {

Belief::Belief(std::span<const std::int64_t> alpha, std::int64_t background, std::int64_t unknown)
    : alpha_(alpha),
      background_(background),
      unknown_(unknown),
      sum_(static_cast<double>(std::accumulate(alpha.begin(), alpha.end(), background + unknown))) {
  SEMSLAM_CHECK(unknown > 0) << unknown;
  std::int64_t most = std::max(background, unknown);
  for (std::size_t c = 0; c < alpha.size(); ++c) {
    if (alpha[c] <= most) continue;
    most = alpha[c];
    best_class_ = static_cast<int>(c);
  }
}

double Belief::ProbabilityOf(int class_id) const {
  return static_cast<double>(alpha_[static_cast<std::size_t>(class_id)]) / sum_;
}

double Belief::background_confidence() const {
  const bool is_background = best_class_ == kNoClass && background_ > unknown_;
  return is_background ? static_cast<double>(background_) / sum_ : 0.0;
}

double Belief::Entropy() const {
  double entropy = 0;
  const auto add = [&](std::int64_t evidence) {
    const double probability = static_cast<double>(evidence) / sum_;
    if (probability > 0) entropy -= probability * std::log(probability);
  };
  std::for_each(alpha_.begin(), alpha_.end(), add);
  add(background_);
  add(unknown_);
  return entropy / std::log(static_cast<double>(alpha_.size() + 2));
}

}  // namespace semslam
